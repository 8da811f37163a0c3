// Pearson's chi-square test of a sampler against its stated density.
#pragma once

#include <functional>
#include <optional>
#include <pah/geometry/vec.hpp>
#include <random>
#include <vector>

namespace pah::test {

using Rng = std::mt19937_64;

inline float uniform(Rng& rng) { return static_cast<float>(rng() >> 40) * 0x1p-24F; }
inline Vec2 uniform2(Rng& rng) {
  const float x = uniform(rng);
  return {x, uniform(rng)};
}

struct ChiSquare {
  double statistic = 0;
  int degrees = 0;
  double p = 1;         // the chance of a statistic at least as large if the density is right
  double integral = 0;  // of the density over the domain
};

// Compares the count of each cell with its expected count. Cells that expect fewer than 5 points
// are pooled.
ChiSquare goodness_of_fit(const std::vector<double>& observed, const std::vector<double>& expected);

// A rectangle in which points are drawn, and their density per surface area.
struct Domain {
  DVec2 min, max;
};
using PointSampler = std::function<std::optional<DVec2>(Rng&)>;
using PointDensity = std::function<double(const DVec2&)>;

// Uses 10 x 20 cells, and a further cell for samples without a point. That cell expects 1 minus the
// integral of the density.
ChiSquare chi_square(const Domain& domain, const PointSampler& sample, const PointDensity& density,
                     int count, Rng& rng);

// Directions, in cells of (cos theta, phi).
using DirectionSampler = std::function<std::optional<Vec3>(Rng&)>;
using DirectionDensity = std::function<double(const Vec3&)>;
ChiSquare chi_square_sphere(const DirectionSampler& sample, const DirectionDensity& density,
                            int count, Rng& rng);

// Returns the bound below which the smallest of `tests` p-values falls with probability 1 %
// (Sidak).
double sidak_level(int tests);

}  // namespace pah::test
