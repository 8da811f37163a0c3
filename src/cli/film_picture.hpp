// What a picture file gets of a film.
#pragma once

#include <pah/io/film_file.hpp>
#include <pah/io/image_file.hpp>
#include <vector>

namespace pah::cli {

// The picture, then what the film was asked to keep besides.
[[nodiscard]] std::vector<ImageLayer> layers_of(const Film& film, const FilmSettings& settings);

[[nodiscard]] ImageMetadata metadata_of(const FilmOrigin& origin, int samples);

// By its extension.
[[nodiscard]] bool is_film_file(const std::filesystem::path& file);

// Throws FileError unless the picture or film can be written; leaves no trace.
void check_output(const std::filesystem::path& file);

}  // namespace pah::cli
