#include "cli/merge/film_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>

#include "base/extension.hpp"
#include "base/output_file.hpp"

namespace pah::cli {

std::vector<ImageLayer> layers_of(const Film& film, const FilmSettings& settings) {
  std::vector<ImageLayer> layers{{"", {"R", "G", "B"}, radiance_of(film)}};
  if (settings.albedo) layers.push_back({"albedo", {"R", "G", "B"}, albedo_of(film)});
  if (settings.normal) layers.push_back({"normal", {"X", "Y", "Z"}, normal_of(film)});
  if (settings.depth) layers.push_back({"depth", {"Z"}, depth_of(film)});
  if (settings.variance) layers.push_back({"variance", {"R", "G", "B"}, variance_of(film)});
  return layers;
}

WriteOptions write_options(const FilmOrigin& origin, int samples, const PictureFormat& format) {
  const FilmSettings& film = origin.film;
  WriteOptions options;
  options.exposure = film.exposure;
  // By default pictures are not rounded to half floats, so that comparisons do not meet that error.
  options.full_float = !format.half;
  options.png_bits = format.png_bits;
  options.metadata = {
      {"pahrender:version", origin.version},
      {"pahrender:scene_hash", origin.scene_hash},
      {"pahrender:samples", std::to_string(samples)},
      {"pahrender:seed", std::to_string(origin.render.seed)},
      {"pahrender:settings", describe_settings(origin)},
      {"pahrender:output", fmt::format("exposure {}, albedo {}, normal {}, depth {}, variance {}, "
                                       "half {}, PNG bits {}",
                                       film.exposure, film.albedo, film.normal, film.depth,
                                       film.variance, format.half, format.png_bits)}};
  return options;
}

bool is_whole(const std::filesystem::path& file, const FilmOrigin& origin,
              const FilmSamples& samples, const PictureFormat& format) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  try {
    if (is_film_file(file)) {
      const FilmFile film = read_film(file);
      return differences(film.origin, origin).empty() && film.samples == samples;
    }
    const ImageMetadata wanted = write_options(origin, samples.to, format).metadata;
    (void)read_image(file);
    const ImageMetadata found = read_metadata(file);
    return std::ranges::all_of(
        wanted, [&](const auto& entry) { return std::ranges::find(found, entry) != found.end(); });
  } catch (const FileError&) {
    return false;
  }
}

bool is_film_file(const std::filesystem::path& file) {
  return lower_extension(file) == film_extension;
}

void check_output(const std::filesystem::path& file) {
  if (is_film_file(file))
    check_can_create(file);
  else
    check_writable(file);
}

}  // namespace pah::cli
