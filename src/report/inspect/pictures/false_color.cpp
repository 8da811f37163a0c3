#include "report/inspect/pictures/false_color.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/srgb.hpp"

namespace pah {
namespace {

// The scheme's values are sRGB-encoded.
float linear(double encoded) {
  return static_cast<float>(linear_from_srgb(std::clamp(encoded, 0.0, 1.0)));
}

}  // namespace

Vec3 false_color(double value) {
  // Green's eq. 2, with his defaults: start 0.5, -1.5 rotations, hue and gamma 1.
  const double v = std::clamp(value, 0.0, 1.0);
  const double angle = 2 * std::numbers::pi * (0.5 / 3 + 1 - 1.5 * v);
  const double amplitude = v * (1 - v) / 2;
  const double c = amplitude * std::cos(angle);
  const double s = amplitude * std::sin(angle);
  return {linear(v - 0.14861 * c + 1.78277 * s), linear(v - 0.29227 * c - 0.90649 * s),
          linear(v + 1.97294 * c)};
}

Image heat_map(const PictureCosts& costs) {
  const CostSummary sum = summarize(costs);
  const auto color = [](std::uint32_t count, std::uint32_t max) {
    return false_color(max == 0 ? 0 : static_cast<double>(count) / max);
  };
  const auto width = static_cast<std::size_t>(costs.width);
  Image image{2 * costs.width, costs.height, std::vector<Vec3>(2 * costs.rays.size())};
  for (std::size_t i = 0; i < costs.rays.size(); ++i) {
    const std::size_t left = i / width * 2 * width + i % width;
    image.pixels[left] = color(costs.rays[i].nodes, sum.max_nodes);
    image.pixels[left + width] = color(costs.rays[i].triangles, sum.max_triangles);
  }
  return image;
}

}  // namespace pah
