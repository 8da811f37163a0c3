#include "report/false_colour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pah {
namespace {

// IEC 61966-2-1. The scheme is in encoded values.
float linear_from_srgb(double encoded) {
  const double v = std::clamp(encoded, 0.0, 1.0);
  return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

}  // namespace

Vec3 false_colour(double value) {
  // Green's eq. 2, with his defaults: start 0.5, -1.5 rotations, hue and gamma 1.
  const double v = std::clamp(value, 0.0, 1.0);
  const double angle = 2 * std::numbers::pi * (0.5 / 3 + 1 - 1.5 * v);
  const double amplitude = v * (1 - v) / 2;
  const double c = amplitude * std::cos(angle);
  const double s = amplitude * std::sin(angle);
  return {linear_from_srgb(v - 0.14861 * c + 1.78277 * s),
          linear_from_srgb(v - 0.29227 * c - 0.90649 * s), linear_from_srgb(v + 1.97294 * c)};
}

Image heat_map(const PictureCosts& costs) {
  const CostSummary sum = summarize(costs);
  const auto colour = [](std::uint32_t count, std::uint32_t max) {
    return false_colour(max == 0 ? 0 : static_cast<double>(count) / max);
  };
  const auto width = static_cast<std::size_t>(costs.width);
  Image image{2 * costs.width, costs.height, std::vector<Vec3>(2 * costs.rays.size())};
  for (std::size_t i = 0; i < costs.rays.size(); ++i) {
    const std::size_t left = i / width * 2 * width + i % width;
    image.pixels[left] = colour(costs.rays[i].nodes, sum.max_nodes);
    image.pixels[left + width] = colour(costs.rays[i].triangles, sum.max_triangles);
  }
  return image;
}

}  // namespace pah
