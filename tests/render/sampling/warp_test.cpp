#include "render/sampling/warp.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "catch.hpp"
#include "chi_square.hpp"

using namespace pah;
using namespace pah::test;

namespace {

constexpr int count = 1'000'000;
constexpr int tests = 11;  // chi-square tests in this file
const double two_pi = glm::two_pi<double>();

void check(const ChiSquare& result) {
  INFO("p = " << result.p << ", statistic " << result.statistic << " of " << result.degrees);
  CHECK(result.p > sidak_level(tests));
  CHECK(result.integral == Approx(1).epsilon(1e-4));
}

}  // namespace

TEST_CASE("Directions on the sphere and hemispheres follow their densities") {
  Rng rng(1);
  check(chi_square_sphere([](Rng& r) { return sample_uniform_sphere(uniform2(r)); },
                          [](const Vec3&) { return pdf_uniform_sphere(); }, count, rng));
  check(chi_square_sphere([](Rng& r) { return sample_cosine_hemisphere(uniform2(r)); },
                          pdf_cosine_hemisphere, count, rng));
}

TEST_CASE("Directions in cones follow their densities") {
  Rng rng(2);
  // The last value is that of the sun: 1 - cos(0.265 degrees).
  for (const float one_minus_cos : {1.5F, 0.3F, 1.07e-5F}) {
    CAPTURE(one_minus_cos);
    const auto sample = [&](Rng& r) -> std::optional<DVec2> {
      const Vec3 w = sample_uniform_cone(uniform2(r), one_minus_cos);
      const double sin2 = static_cast<double>(w.x) * w.x + static_cast<double>(w.y) * w.y;
      const double cos_theta = std::copysign(std::sqrt(1 - std::min(1.0, sin2)), w.z);
      const double h = w.z > 0 ? sin2 / (1 + cos_theta) : 1 - cos_theta;
      return DVec2{h, std::atan2(w.y, w.x)};
    };
    check(chi_square(
        {{0, -two_pi / 2}, {one_minus_cos, two_pi / 2}}, sample,
        [&](const DVec2&) { return pdf_uniform_cone(one_minus_cos); }, count, rng));
  }
}

TEST_CASE("Points in the disk and the triangle are uniform") {
  Rng rng(3);
  const auto disk = [](Rng& r) -> std::optional<DVec2> {
    const Vec2 p = sample_unit_disk(uniform2(r));
    return DVec2{glm::dot(p, p), std::atan2(p.y, p.x)};
  };
  check(chi_square(
      {{0, -two_pi / 2}, {1, two_pi / 2}}, disk,
      [](const DVec2&) { return 0.5 / glm::pi<double>(); }, count, rng));
  // In coordinates (u + v, v / (u + v)) the density 2 is 2 (u + v).
  const auto triangle = [](Rng& r) -> std::optional<DVec2> {
    const Vec2 p = sample_uniform_triangle(uniform2(r));
    return DVec2{p.x + p.y, p.y / std::max(p.x + p.y, 1e-20F)};
  };
  check(chi_square(
      {{0, 0}, {1, 1}}, triangle, [](const DVec2& p) { return 2 * p.x; }, count, rng));
}

TEST_CASE("Filter offsets follow the filters") {
  Rng rng(4);
  const float radius = 1.5F;
  const auto offset = [&](Rng& r) -> std::optional<DVec2> {
    return DVec2{sample_blackman_harris(uniform2(r), radius)};
  };
  const Domain domain{DVec2{-radius}, DVec2{radius}};
  // The exact window, not its linear interpolation between knots.
  const auto window = [](double x) {
    const double t = glm::pi<double>() * x;
    return (0.35875 + 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) +
            0.01168 * std::cos(3 * t)) /
           0.7175;
  };
  check(chi_square(
      domain, offset,
      [&](const DVec2& p) {
        return window(p.x / radius) * window(p.y / radius) / (radius * radius);
      },
      count, rng));
  check(chi_square(
      domain,
      [&](Rng& r) -> std::optional<DVec2> { return DVec2{sample_box(uniform2(r), radius)}; },
      [&](const DVec2&) { return 1.0 / 9; }, count, rng));
}

TEST_CASE("The corners of the unit square map to their places") {
  const float last = 1 - 0x1p-24F;
  for (const Vec2 u : {Vec2{0, 0}, Vec2{last, 0}, Vec2{0, last}, Vec2{last, last}, Vec2{0.5F}}) {
    CAPTURE(u.x, u.y);
    for (const Vec3& w :
         {sample_uniform_sphere(u), sample_cosine_hemisphere(u), sample_uniform_cone(u, 1e-6F)}) {
      CHECK(glm::length(w) == Approx(1).margin(1e-6));
    }
    CHECK(sample_cosine_hemisphere(u).z >= 0);
    CHECK(glm::length(sample_unit_disk(u)) <= 1 + 1e-6F);
    const Vec2 b = sample_uniform_triangle(u);
    CHECK(b.x >= 0);
    CHECK(b.y >= 0);
    CHECK(b.x + b.y <= 1 + 1e-6F);
    const Vec2 offset = sample_blackman_harris(u, 2);
    CHECK(glm::all(glm::lessThanEqual(glm::abs(offset), Vec2{2})));
  }
}

TEST_CASE("The chi-square test rejects a wrong density") {
  Rng rng(5);
  const auto cosine = [](Rng& r) { return sample_cosine_hemisphere(uniform2(r)); };
  const auto uniform = [](const Vec3& w) { return w.z >= 0 ? 0.5 / glm::pi<double>() : 0; };
  CHECK(chi_square_sphere(cosine, uniform, count, rng).p < 1e-6);
  const auto tilted = [](const Vec3& w) {
    return pdf_cosine_hemisphere(w) * (1 + 0.02 * static_cast<double>(w.x));
  };
  CHECK(chi_square_sphere(cosine, tilted, count, rng).p < 1e-6);
  const auto too_small = [](const Vec3& w) { return 0.98 * pdf_cosine_hemisphere(w); };
  CHECK(chi_square_sphere(cosine, too_small, count, rng).p < 1e-6);
}
