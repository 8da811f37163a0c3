#include "chi_square.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

namespace pah::test {
namespace {

constexpr int rows = 10, columns = 20;

// The upper regularized incomplete gamma function (Abramowitz and Stegun, 6.5.29 and 6.5.31).
double gamma_q(double a, double x) {
  if (x <= 0) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; term > 1e-16 * sum; ++n) sum += term *= x / (a + n);
    return 1 - front * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int n = 1; n < 100000; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= c * d;
    if (std::abs(c * d - 1) < 1e-15) break;
  }
  return front * h;
}

double gauss(const PointDensity& f, const DVec2& a, const DVec2& b) {
  static const double node = std::sqrt(0.6);
  static const double nodes[] = {-node, 0, node};
  static const double weights[] = {5 / 18.0, 8 / 18.0, 5 / 18.0};
  const DVec2 center = 0.5 * (a + b), half = 0.5 * (b - a);
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      sum += weights[i] * weights[j] * f(center + half * DVec2{nodes[i], nodes[j]});
  return sum * 4 * half.x * half.y;
}

// Halves where two estimates differ by more than the tolerance.
double integrate(const PointDensity& f, const DVec2& a, const DVec2& b, double whole,
                 double tolerance, int depth) {
  const DVec2 m = 0.5 * (a + b);
  const DVec2 corners[4][2] = {{a, m}, {{m.x, a.y}, {b.x, m.y}}, {{a.x, m.y}, {m.x, b.y}}, {m, b}};
  double parts[4], sum = 0;
  for (int i = 0; i < 4; ++i) sum += parts[i] = gauss(f, corners[i][0], corners[i][1]);
  if (depth == 0 || std::abs(sum - whole) < tolerance) return sum;
  sum = 0;
  for (int i = 0; i < 4; ++i)
    sum += integrate(f, corners[i][0], corners[i][1], parts[i], tolerance, depth - 1);
  return sum;
}

}  // namespace

ChiSquare goodness_of_fit(const std::vector<double>& observed,
                          const std::vector<double>& expected) {
  ChiSquare result;
  double pooled_expected = 0, pooled_observed = 0;
  int cells = 0;
  const auto add = [&](double e, double o) {
    result.statistic += (o - e) * (o - e) / e;
    ++cells;
  };
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] >= 5) {
      add(expected[i], observed[i]);
    } else {
      pooled_expected += expected[i];
      pooled_observed += observed[i];
    }
  }
  // A pool that expects almost no points must still not receive many.
  if (pooled_expected > 0 || pooled_observed > 0)
    add(std::max(pooled_expected, 1.0), pooled_observed);
  result.degrees = std::max(1, cells - 1);
  result.p = gamma_q(0.5 * result.degrees, 0.5 * result.statistic);
  return result;
}

ChiSquare chi_square(const Domain& domain, const PointSampler& sample, const PointDensity& density,
                     int count, Rng& rng) {
  const DVec2 cell = (domain.max - domain.min) / DVec2{rows, columns};
  std::vector<double> expected, observed(rows * columns + 1, 0);
  ChiSquare result;
  // A hundredth of a point.
  const double tolerance = 0.01 / count;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      // Starts with several parts, so that a narrow peak between the nodes is not missed.
      double sum = 0;
      const DVec2 corner = domain.min + cell * DVec2{i, j};
      for (int k = 0; k < 16; ++k) {
        const DVec2 a = corner + 0.25 * cell * DVec2{k % 4, k / 4}, b = a + 0.25 * cell;
        sum += integrate(density, a, b, gauss(density, a, b), tolerance, 8);
      }
      expected.push_back(sum * count);
      result.integral += sum;
    }
  }
  expected.push_back(std::max(0.0, 1 - result.integral) * count);

  for (int n = 0; n < count; ++n) {
    const std::optional<DVec2> point = sample(rng);
    std::size_t index = rows * columns;
    if (point) {
      const DVec2 position = (*point - domain.min) / cell;
      const int i = std::clamp(static_cast<int>(position.x), 0, rows - 1);
      const int j = std::clamp(static_cast<int>(position.y), 0, columns - 1);
      index = static_cast<std::size_t>(i * columns + j);
    }
    ++observed[index];
  }

  const double integral = result.integral;
  result = goodness_of_fit(observed, expected);
  result.integral = integral;
  return result;
}

// The cells' axis is askew to z. Densities often jump at a height: where cells have their edges
// along it, all parts there err by the same sign, and the sum is off by more than a million draws'
// noise.
ChiSquare chi_square_sphere(const DirectionSampler& sample, const DirectionDensity& density,
                            int count, Rng& rng) {
  static const DVec3 axis = glm::normalize(DVec3{0.4, -0.3, 0.85});
  static const DVec3 side = glm::normalize(glm::cross(axis, DVec3{1, 0, 0}));
  static const glm::dmat3 from_cells{side, glm::cross(axis, side), axis};
  const double two_pi = glm::two_pi<double>();
  return chi_square(
      {{-1, 0}, {1, two_pi}},
      [&](Rng& r) -> std::optional<DVec2> {
        const std::optional<Vec3> drawn = sample(r);
        if (!drawn) return std::nullopt;
        const DVec3 w = glm::transpose(from_cells) * DVec3{*drawn};
        const double phi = std::atan2(w.y, w.x);
        return DVec2{w.z, phi < 0 ? phi + two_pi : phi};
      },
      [&](const DVec2& p) {
        const double r = std::sqrt(std::max(0.0, 1 - p.x * p.x));
        return density(Vec3{from_cells * DVec3{r * std::cos(p.y), r * std::sin(p.y), p.x}});
      },
      count, rng);
}

double sidak_level(int tests) { return 1 - std::pow(0.99, 1.0 / tests); }

}  // namespace pah::test
