// Uniform numbers in [0, 1)^2 to directions and points, each with its density. z is up.
#pragma once

#include <pah/geometry/vec.hpp>

namespace pah {

// Directions; densities per solid angle.
[[nodiscard]] Vec3 sample_uniform_sphere(Vec2 u);
[[nodiscard]] float pdf_uniform_sphere();
[[nodiscard]] Vec3 sample_cosine_hemisphere(Vec2 u);
[[nodiscard]] float pdf_cosine_hemisphere(const Vec3& w);

// The directions within an angle of +z, given as 1 - cos(angle) in (0, 2]: for the narrow cones of
// suns the cosine itself has no digits left.
[[nodiscard]] Vec3 sample_uniform_cone(Vec2 u, float one_minus_cos);
[[nodiscard]] float pdf_uniform_cone(float one_minus_cos);

// Points in the unit disk (Shirley and Chiu's concentric map); density per area 1 / pi.
[[nodiscard]] Vec2 sample_unit_disk(Vec2 u);

// Barycentric weights of a triangle's second and third vertex; density per area 1 / area.
[[nodiscard]] Vec2 sample_uniform_triangle(Vec2 u);

// An offset from the pixel's center, distributed as the Blackman-Harris window over
// [-radius, radius]^2, or uniform for the box filter. All samples then weigh the same.
[[nodiscard]] Vec2 sample_blackman_harris(Vec2 u, float radius);
[[nodiscard]] Vec2 sample_box(Vec2 u, float radius);

}  // namespace pah
