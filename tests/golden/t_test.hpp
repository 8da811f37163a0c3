// Whether two pictures differ by more than chance, pixel by pixel.
#pragma once

#include <vector>

#include "batches.hpp"

namespace pah::golden {

// The chance that |T| >= |t|, where T follows Student's distribution.
[[nodiscard]] double two_sided_p(double t, double degrees_of_freedom);

// The level for each of `tests` independent tests, so that the chance of any false alarm among them
// is `alpha`: Sidak, "Rectangular confidence regions for the means of multivariate normal
// distributions" (1967).
[[nodiscard]] double sidak(double alpha, std::size_t tests);

struct Comparison {
  std::vector<double> p;  // by pixel: that of its most doubtful channel
  double level = 0;       // a pixel passes if its p is not below
  double passed = 0;      // share of the pixels
};

// Student's test with pooled variance for each channel of each pixel, alpha 0.01 over all of them.
// Batches of both pictures must have as many samples each: if nothing has changed, all of them are
// draws from one distribution, and the reference's many tell the spread of the picture's few.
// Pictures must be of one size.
[[nodiscard]] Comparison compare(const Batches& reference, const Batches& picture);

// What must pass. At the Sidak level all do, but for one picture in a hundred; the rest is room
// for rare bright paths, which the normal distribution of the means does not know.
inline constexpr double passing_share = 0.9975;

}  // namespace pah::golden
