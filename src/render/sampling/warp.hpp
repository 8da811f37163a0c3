// Maps uniform numbers in [0, 1)^2 to directions and points, each with its density. z is up.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <pah/geometry/vec.hpp>

namespace pah {

// Directions; densities per solid angle.
[[nodiscard]] Vec3 sample_uniform_sphere(Vec2 u);
[[nodiscard]] float pdf_uniform_sphere();
[[nodiscard]] inline Vec3 sample_cosine_hemisphere(Vec2 u);
[[nodiscard]] inline float pdf_cosine_hemisphere(const Vec3& w) {
  return std::max(0.0F, w.z) * std::numbers::inv_pi_v<float>;
}

// The directions within an angle of +z, given as 1 - cos(angle) in (0, 2]: for the narrow cones of
// suns the cosine itself has no digits left.
[[nodiscard]] Vec3 sample_uniform_cone(Vec2 u, float one_minus_cos);
[[nodiscard]] float pdf_uniform_cone(float one_minus_cos);

// Points in the unit disk (Shirley and Chiu's concentric map); density per area 1 / pi.
[[nodiscard]] inline Vec2 sample_unit_disk(Vec2 u);

// Barycentric weights of a triangle's second and third vertex; density per area 1 / area.
[[nodiscard]] Vec2 sample_uniform_triangle(Vec2 u);

// An offset from the pixel's center, distributed as the Blackman-Harris window over
// [-radius, radius]^2, or uniform for the box filter. All samples then weigh the same.
[[nodiscard]] Vec2 sample_blackman_harris(Vec2 u, float radius);
[[nodiscard]] Vec2 sample_box(Vec2 u, float radius);

inline Vec2 sample_unit_disk(Vec2 u) {
  const Vec2 s = 2.0F * u - 1.0F;
  const bool x_larger = std::abs(s.x) > std::abs(s.y);
  const float r = x_larger ? s.x : s.y;
  if (r == 0) return {0, 0};
  // Taylor's series: up to pi / 4 they are off by 2e-9 and 2.5e-8 at most.
  const float a = std::numbers::pi_v<float> / 4 * ((x_larger ? s.y : s.x) / r);
  const float a2 = a * a;
  const float sine =
      r * a * (1 + a2 * (-1.0F / 6 + a2 * (1.0F / 120 + a2 * (-1.0F / 5040 + a2 / 362880))));
  const float cosine = r * (1 + a2 * (-0.5F + a2 * (1.0F / 24 + a2 * (-1.0F / 720 + a2 / 40320))));
  return x_larger ? Vec2{cosine, sine} : Vec2{sine, cosine};
}

inline Vec3 sample_cosine_hemisphere(Vec2 u) {
  const Vec2 d = sample_unit_disk(u);
  return {d, std::sqrt(std::max(0.0F, 1 - glm::dot(d, d)))};
}

}  // namespace pah
