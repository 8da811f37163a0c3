// Turns films into layers and metadata of picture files.
#pragma once

#include <pah/image/image_file.hpp>
#include <pah/render/film_file.hpp>
#include <vector>

namespace pah::cli {

// Returns the picture, then the further layers that the settings ask for.
[[nodiscard]] std::vector<ImageLayer> layers_of(const Film& film, const FilmSettings& settings);

struct PictureFormat {
  bool half = false;  // EXR files in 16-bit floats
  int png_bits = 8;
};

// Returns the options for writing a film with `samples` per pixel; its origin becomes metadata.
[[nodiscard]] WriteOptions write_options(const FilmOrigin& origin, int samples,
                                         const PictureFormat& format);

// Returns whether the file exists, can be read to its end, and holds what would be rendered. For
// formats without metadata the answer is false.
[[nodiscard]] bool is_whole(const std::filesystem::path& file, const FilmOrigin& origin,
                            const FilmSamples& samples, const PictureFormat& format);

// Decides by the extension.
[[nodiscard]] bool is_film_file(const std::filesystem::path& file);

// Throws FileError if the picture or film cannot be written. Leaves no file behind.
void check_output(const std::filesystem::path& file);

}  // namespace pah::cli
