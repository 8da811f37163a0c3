// What a picture file gets of a film.
#pragma once

#include <pah/image/image_file.hpp>
#include <pah/render/film_file.hpp>
#include <vector>

namespace pah::cli {

// The picture, then what the film was asked to keep besides.
[[nodiscard]] std::vector<ImageLayer> layers_of(const Film& film, const FilmSettings& settings);

struct PictureFormat {
  bool half = false;  // EXR files in 16-bit floats
  int png_bits = 8;
};

// How a film of so many samples is written, with where it comes from as metadata.
[[nodiscard]] WriteOptions write_options(const FilmOrigin& origin, int samples,
                                         const PictureFormat& format);

// Whether the file is there, can be read to its end, and is what would be rendered. Of formats that
// keep no metadata this is not known: false.
[[nodiscard]] bool is_whole(const std::filesystem::path& file, const FilmOrigin& origin,
                            const FilmSamples& samples, const PictureFormat& format);

// By its extension.
[[nodiscard]] bool is_film_file(const std::filesystem::path& file);

// Throws FileError unless the picture or film can be written; leaves no trace.
void check_output(const std::filesystem::path& file);

}  // namespace pah::cli
