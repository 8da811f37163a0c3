#include "cli/film_picture.hpp"

#include <string>

#include "io/extension.hpp"
#include "io/output_file.hpp"

namespace pah::cli {

std::vector<ImageLayer> layers_of(const Film& film, const FilmSettings& settings) {
  std::vector<ImageLayer> layers{{"", {"R", "G", "B"}, radiance_of(film)}};
  if (settings.albedo) layers.push_back({"albedo", {"R", "G", "B"}, albedo_of(film)});
  if (settings.normal) layers.push_back({"normal", {"X", "Y", "Z"}, normal_of(film)});
  if (settings.depth) layers.push_back({"depth", {"Z"}, depth_of(film)});
  if (settings.variance) layers.push_back({"variance", {"R", "G", "B"}, variance_of(film)});
  return layers;
}

ImageMetadata metadata_of(const FilmOrigin& origin, int samples) {
  return {{"pahrender:version", origin.version},
          {"pahrender:scene_hash", origin.scene_hash},
          {"pahrender:samples", std::to_string(samples)},
          {"pahrender:seed", std::to_string(origin.render.seed)}};
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
