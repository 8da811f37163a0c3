#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <pah/image/clipping.hpp>

namespace pah {
namespace {

// Rec. 709 luminance.
constexpr glm::vec3 luminance_weights{0.2126F, 0.7152F, 0.0722F};

}  // namespace

Clipping measure_clipping(const Image& image, double exposure) {
  if (image.pixels.empty()) return {0, exposure};
  std::vector<float> luminances;
  luminances.reserve(image.pixels.size());
  for (const glm::vec3& pixel : image.pixels) {
    const float luminance = glm::dot(pixel, luminance_weights);
    luminances.push_back(luminance > 0 ? luminance : 0);
  }
  const double white = std::exp2(-exposure);
  const auto clipped =
      std::ranges::count_if(luminances, [&](float value) { return double{value} > white; });
  const auto count = static_cast<double>(luminances.size());
  const auto high = luminances.begin() + static_cast<std::ptrdiff_t>(0.95 * (count - 1));
  std::nth_element(luminances.begin(), high, luminances.end());
  Clipping clipping{static_cast<double>(clipped) / count, exposure};
  if (*high > 0 && std::isfinite(*high)) clipping.exposure = -std::log2(double{*high});
  return clipping;
}

}  // namespace pah
