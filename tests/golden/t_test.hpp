// Tests for each pixel whether two pictures differ by more than chance.
#pragma once

#include <vector>

#include "batches.hpp"

namespace pah::golden {

// Returns the probability that |T| >= |t|, where T follows Student's distribution.
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

// Student's test with pooled variance for each channel of each pixel, at level 0.01 for all of them
// together. All batches must have the same number of samples: if nothing has changed, they are
// draws from one distribution, and the many batches of the reference give the variance of the few
// batches of the picture. Both pictures must have the same size.
[[nodiscard]] Comparison compare(const Batches& reference, const Batches& picture);

// The share of pixels that must pass. At the Sidak level all pixels pass in 99 of 100 pictures. The
// margin is for rare bright paths, with which means are not normally distributed.
inline constexpr double passing_share = 0.9975;

}  // namespace pah::golden
