#include "failure_pictures.hpp"

#include <cmath>
#include <pah/image/image_file.hpp>

#include "support/paths.hpp"

namespace pah::golden {
namespace {

// Returns a gray value by the logarithm of p, black at the level.
Vec3 shade(double p, double level) {
  if (p < level) return {1, 0, 0};
  return Vec3(static_cast<float>(1 - std::log(p) / std::log(level)));
}

}  // namespace

std::filesystem::path write_failure(const std::string& name, const Batches& reference,
                                    const Batches& picture, const Comparison& comparison) {
  const std::filesystem::path folder = test::build_folder() / "golden_failures";
  std::filesystem::create_directories(folder);
  Image image{picture.width(), picture.height(), {}};
  Image difference = image, p_values = image;
  for (std::size_t i = 0; i < picture.mean().size(); ++i) {
    image.pixels.emplace_back(picture.mean()[i]);
    difference.pixels.emplace_back(picture.mean()[i] - reference.mean()[i]);
    p_values.pixels.push_back(shade(comparison.p[i], comparison.level));
  }
  WriteOptions options;
  options.full_float = true;
  const auto write = [&](const std::string& kind, Image pixels) {
    write_image(folder / (name + kind), {{"", {"R", "G", "B"}, std::move(pixels)}}, options);
  };
  write("_image.exr", std::move(image));
  write("_difference.exr", std::move(difference));
  write("_p_value.png", std::move(p_values));
  return folder;
}

}  // namespace pah::golden
