#include <algorithm>
#include <cmath>
#include <limits>
#include <pah/image/compare.hpp>
#include <stdexcept>
#include <string>

namespace pah {

ImageDifference compare_images(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.pixels.size() != b.pixels.size())
    throw std::invalid_argument("pictures of different sizes: " + std::to_string(a.width) + " x " +
                                std::to_string(a.height) + " and " + std::to_string(b.width) +
                                " x " + std::to_string(b.height));
  ImageDifference difference;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const double reference = b.pixels[i][k];
      double error = std::abs(a.pixels[i][k] - reference);
      double relative = error * error / (reference * reference + 0.01);
      if (!std::isfinite(error)) error = relative = std::numeric_limits<double>::infinity();
      difference.mse += error * error;
      difference.relmse += relative;
      difference.max = std::max(difference.max, error);
    }
  }
  const double count = 3 * static_cast<double>(a.pixels.size());
  if (count > 0) {
    difference.mse /= count;
    difference.relmse /= count;
  }
  return difference;
}

}  // namespace pah
