#include "render/sampling/drawn_numbers.hpp"

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "catch.hpp"

using namespace pah;

namespace {

// Returns whether each cell of a columns x rows grid holds exactly one point.
bool one_each(const std::vector<Vec2>& points, int log_columns, int log_rows) {
  std::vector<int> count(points.size(), 0);
  for (const Vec2& p : points) {
    const auto x = static_cast<std::size_t>(std::ldexp(p.x, log_columns));
    const auto y = static_cast<std::size_t>(std::ldexp(p.y, log_rows));
    if (++count[(y << log_columns) + x] > 1) return false;
  }
  return true;
}

std::vector<Vec2> points_2d(int log_count, std::uint32_t x, int dimension, std::uint64_t seed = 1) {
  std::vector<Vec2> points;
  for (std::uint32_t i = 0; i < (1U << log_count); ++i) {
    Sampler sampler(x, 7, i, seed);
    for (int d = 0; d < dimension; ++d) (void)sampler.next_2d();
    points.push_back(sampler.next_2d());
  }
  return points;
}

double correlation(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (static_cast<double>(a[i].x) - 0.5) * (static_cast<double>(b[i].x) - 0.5);
  }
  return 12 * sum / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("The first 2^k points of a pixel are a (0,k,2)-net in every dimension") {
  for (int k = 0; k <= 10; ++k) {
    for (std::uint32_t pixel = 0; pixel < 4; ++pixel) {
      for (int dimension = 0; dimension < 4; ++dimension) {
        const std::vector<Vec2> points = points_2d(k, pixel, dimension);
        for (int columns = 0; columns <= k; ++columns) {
          CAPTURE(k, pixel, dimension, columns);
          REQUIRE(one_each(points, columns, k - columns));
        }
      }
    }
  }
}

TEST_CASE("The first 2^k numbers of a pixel lie in different intervals") {
  for (int k = 0; k <= 12; ++k) {
    for (int dimension = 0; dimension < 5; ++dimension) {
      std::set<int> cells;
      for (std::uint32_t i = 0; i < (1U << k); ++i) {
        Sampler sampler(3, 4, i, 99);
        for (int d = 0; d < dimension; ++d) (void)sampler.next_1d();
        const float u = sampler.next_1d();
        REQUIRE(u >= 0);
        REQUIRE(u < 1);
        cells.insert(static_cast<int>(std::ldexp(u, k)));
      }
      CAPTURE(k, dimension);
      REQUIRE(cells.size() == (std::size_t{1} << k));
    }
  }
}

TEST_CASE("Dimensions, pixels and seeds are uncorrelated") {
  // Means over many pairs: a single pair of nets of n points correlates by up to about 1 / sqrt(n).
  constexpr int pairs = 400, log_count = 6;
  const double bound = 4 / std::sqrt(static_cast<double>(pairs << log_count));
  double dimensions = 0, pixels = 0, seeds = 0;
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const std::vector<Vec2> a = points_2d(log_count, i, 0);
    dimensions += correlation(a, points_2d(log_count, i, 1)) / pairs;
    pixels += correlation(a, points_2d(log_count, i + 1, 0)) / pairs;
    seeds += correlation(a, points_2d(log_count, i, 0, 2)) / pairs;
  }
  CHECK(std::abs(dimensions) < bound);
  CHECK(std::abs(pixels) < bound);
  CHECK(std::abs(seeds) < bound);
}

TEST_CASE("One sample of every pixel is uniform") {
  // With scrambling each single point is uniform too, here in 16 x 16 cells.
  std::array<int, 256> count{};
  constexpr int pixels = 1 << 16;
  for (std::uint32_t i = 0; i < pixels; ++i) {
    const Vec2 u = Sampler(i & 255U, i >> 8U, 5, 0).next_2d();
    ++count[static_cast<std::size_t>(static_cast<int>(u.y * 16) * 16 + static_cast<int>(u.x * 16))];
  }
  double statistic = 0;
  for (const int c : count) statistic += (c - 256.0) * (c - 256.0) / 256;
  // 255 degrees of freedom: mean 255, deviation 22.6.
  CHECK(statistic < 255 + 4 * 22.6);
  CHECK(statistic > 255 - 4 * 22.6);
}

TEST_CASE("A smooth integrand converges faster than by chance") {
  // Owen: the variance of a scrambled net falls as n^-3 (log n); by chance as n^-1.
  const auto variance = [](int log_count) {
    double sum = 0;
    constexpr int pixels = 64;
    for (std::uint32_t p = 0; p < pixels; ++p) {
      double mean = 0;
      for (const Vec2& u : points_2d(log_count, p, 0)) mean += std::exp(u.x) * std::exp(u.y);
      mean /= 1 << log_count;
      const double error = mean - std::pow(std::exp(1.0) - 1, 2);
      sum += error * error / pixels;
    }
    return sum;
  };
  const double order = std::log2(variance(4) / variance(10)) / 6;
  CHECK(order > 2.3);
}

TEST_CASE("A sampler depends on its arguments alone") {
  Sampler a(1, 2, 3, 4), b(1, 2, 3, 4);
  for (int i = 0; i < 10; ++i) {
    CHECK(a.next_1d() == b.next_1d());
    CHECK(a.next_2d() == b.next_2d());
  }
  CHECK(Sampler(1, 2, 3, 4).next_1d() != Sampler(2, 1, 3, 4).next_1d());
  CHECK(Sampler(1, 2, 3, 4).next_1d() != Sampler(1, 2, 3, 5).next_1d());
  // Recorded values: every platform must draw the same numbers.
  Sampler c(640, 480, 77, 0x123456789ULL);
  CHECK(c.next_1d() == 0x1.9ffb7cp-2F);
  CHECK(c.next_2d() == Vec2{0x1.00a04p-5F, 0x1.b65a7cp-1F});
}

TEST_CASE("Numbers drawn side by side are those of each sampler") {
  DrawnNumbers numbers;
  std::vector<Sampler> samplers;
  for (std::uint32_t lane = 0; lane < DrawnNumbers::lanes; ++lane) {
    samplers.emplace_back(lane * 977, lane, 0x9E3779B9U * lane, lane);
    samplers.back().skip(lane * lane);
    numbers.set(lane, samplers.back());
  }
  numbers.draw(DrawnNumbers::most_dimensions);
  for (std::size_t lane = 0; lane < samplers.size(); ++lane) {
    CAPTURE(lane);
    NumberReader reader(numbers, lane);
    Sampler& sampler = samplers[lane];
    for (std::size_t i = 0; i < DrawnNumbers::most_dimensions; i += 2) {
      CHECK(reader.next_2d() == sampler.next_2d());
      CHECK(reader.next_1d() == sampler.next_1d());
    }
    CHECK(reader.used() == DrawnNumbers::most_dimensions);
  }
}
