// Measures the difference between two pictures.
#pragma once

#include <pah/image/image.hpp>

namespace pah {

// Differences between two pictures of one size; `b` is the reference. Where either is not finite,
// the difference is infinite.
struct ImageDifference {
  double mse = 0;
  double relmse = 0;  // mean over pixels and channels of (a - b)^2 / (b^2 + 0.01)
  double max = 0;     // largest absolute difference of a channel
};
// Throws std::invalid_argument if the sizes differ.
[[nodiscard]] ImageDifference compare_images(const Image& a, const Image& b);

}  // namespace pah
