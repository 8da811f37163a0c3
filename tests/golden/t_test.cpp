#include "t_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pah::golden {
namespace {

// The continued fraction of the incomplete beta function (DLMF 8.17.22), by Lentz's method. It
// converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double x, double a, double b) {
  constexpr double tiny = std::numeric_limits<double>::min();
  const auto away_from_zero = [](double v) { return std::abs(v) < tiny ? tiny : v; };
  double c = 1;
  double d = 1 / away_from_zero(1 - (a + b) * x / (a + 1));
  double value = d;
  for (int m = 1; m < 1000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    double step = 1;
    for (const double coefficient : {even, odd}) {
      d = 1 / away_from_zero(1 + coefficient * d);
      c = away_from_zero(1 + coefficient / c);
      step = c * d;
      value *= step;
    }
    if (std::abs(step - 1) < std::numeric_limits<double>::epsilon()) break;
  }
  return value;
}

// The regularized incomplete beta function I_x(a, b), DLMF 8.17.
double incomplete_beta(double x, double a, double b) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double factor = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                 a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1) / (a + b + 2)) return factor * beta_fraction(x, a, b) / a;
  return 1 - factor * beta_fraction(1 - x, b, a) / b;
}

// Radiance is a product of a few dozen rounded floats at most. Compilers and mathematical libraries
// may differ by this much in pixels without noise.
constexpr double rounding = 32.0 * std::numeric_limits<float>::epsilon() / 2;

double p_of_channel(double reference, double reference_variance, int reference_count,
                    double picture, double picture_variance, int picture_count) {
  const double allowed = rounding * std::max(std::abs(reference), std::abs(picture));
  const double difference = std::abs(reference - picture) - allowed;
  if (difference <= 0) return 1;
  const double degrees = reference_count + picture_count - 2;
  const double variance =
      ((reference_count - 1) * reference_variance + (picture_count - 1) * picture_variance) /
      degrees;
  const double error = std::sqrt(variance * (1.0 / reference_count + 1.0 / picture_count));
  return error > 0 ? two_sided_p(difference / error, degrees) : 0;
}

}  // namespace

double two_sided_p(double t, double degrees_of_freedom) {
  return incomplete_beta(degrees_of_freedom / (degrees_of_freedom + t * t), degrees_of_freedom / 2,
                         0.5);
}

double sidak(double alpha, std::size_t tests) {
  return -std::expm1(std::log1p(-alpha) / static_cast<double>(tests));
}

Comparison compare(const Batches& reference, const Batches& picture) {
  const std::size_t pixels = reference.mean().size();
  Comparison comparison;
  comparison.level = sidak(0.01, 3 * pixels);
  comparison.p.resize(pixels, 1);
  std::size_t passed = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const DVec3 reference_variance = reference.variance(i), picture_variance = picture.variance(i);
    for (int c = 0; c < 3; ++c)
      comparison.p[i] =
          std::min(comparison.p[i],
                   p_of_channel(reference.mean()[i][c], reference_variance[c], reference.count(),
                                picture.mean()[i][c], picture_variance[c], picture.count()));
    passed += comparison.p[i] >= comparison.level ? 1U : 0U;
  }
  comparison.passed = static_cast<double>(passed) / static_cast<double>(pixels);
  return comparison;
}

}  // namespace pah::golden
