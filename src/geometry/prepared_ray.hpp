// Rays prepared for box and triangle tests: one, or four side by side by the same formulas.
#pragma once

#include <limits>
#include <pah/geometry/ray.hpp>

#include "geometry/float4.hpp"
#include "geometry/rounding.hpp"

namespace pah {

// Real is float, or Float4 for four rays.
template <typename Real>
struct Prepared {
  // For the slab test of boxes: t = plane * inverse + offset (ray_box.hpp).
  Real inverse[3];
  Real near_offset[3];
  Real far_offset[3];

  // For the triangle test: the axis of the direction's largest component becomes z, the next two
  // axes become x and y, and a shear aligns the ray with z.
  Real origin[3];
  Real shear_x;
  Real shear_y;
  Real scale_z;
  IntOf<Real> z_axis;

  Real t_max;  // -1 for a ray that hits nothing: every interval starts at 0 or above
};
using PreparedRay = Prepared<float>;

// next_axis[z] is the axis of x, and next_axis[x] that of y.
inline constexpr std::size_t next_axis[3] = {1, 2, 0};

// The padding of planes and origins, in units of the largest coordinate, and the size, relative to
// the largest, below which components of the direction are enlarged. ray_box.hpp derives both.
inline constexpr float box_padding = rounding_bound(42);
inline constexpr float smallest_component = 0x1p-27F;

// The range of a direction's largest component in which no digits are lost, and the largest
// coordinate of an origin in units of that component. Rays outside of these limits (and NaN) hit
// nothing.
inline constexpr float min_direction = 0x1p-100F;
inline constexpr float max_direction = 0x1p100F;
inline constexpr float max_origin = 0x1p99F;

// Always inlined: see ray_triangle.hpp.
template <typename Real>
[[nodiscard, gnu::always_inline]] inline Prepared<Real> prepare(const Real (&origin)[3],
                                                                const Real (&direction)[3],
                                                                const Real& t_max) {
  const auto splat = [](float x) __attribute__((always_inline)) { return Real{} + x; };
  const auto largest_of =
      [](const Real& x, const Real& y, const Real& z) __attribute__((always_inline)) {
    return max(max(x, y), z);
  };
  constexpr float tiny = 2 * std::numeric_limits<float>::denorm_min();
  Prepared<Real> ray;

  const Real size[3] = {abs(direction[0]), abs(direction[1]), abs(direction[2])};
  const Real largest = largest_of(size[0], size[1], size[2]);
  const Real far_away = largest_of(abs(origin[0]), abs(origin[1]), abs(origin[2]));
  Real zero = splat(0);  // NaN if any input is not finite
  for (int axis = 0; axis < 3; ++axis) {
    const Real limited = max(size[axis], smallest_component * largest);
    const Real inverse = 1 / with_sign_of(limited, direction[axis]);
    const Real offset = -(origin[axis] * inverse);
    const Real widening = box_padding * far_away * abs(inverse) + tiny;
    ray.inverse[axis] = inverse;
    ray.near_offset[axis] = offset - widening;
    ray.far_offset[axis] = offset + widening;
    zero = zero + 0 * origin[axis] + 0 * direction[axis];
  }
  const auto usable = (largest >= min_direction) & (largest <= max_direction) &
                      (far_away <= max_origin * largest) & (zero == 0) & (t_max > 0);
  ray.t_max = usable ? min(t_max, splat(std::numeric_limits<float>::max())) : splat(-1);

  const auto along_x = size[0] == largest;
  const auto along_y = size[1] == largest;
  const auto by_axis = [&](const auto& x, const auto& y, const auto& z)
      __attribute__((always_inline)) {
    return along_x ? x : along_y ? y : z;
  };
  ray.z_axis = by_axis(IntOf<Real>{}, IntOf<Real>{} + 1, IntOf<Real>{} + 2);
  ray.origin[0] = by_axis(origin[1], origin[2], origin[0]);
  ray.origin[1] = by_axis(origin[2], origin[0], origin[1]);
  ray.origin[2] = by_axis(origin[0], origin[1], origin[2]);
  ray.scale_z = by_axis(ray.inverse[0], ray.inverse[1], ray.inverse[2]);
  ray.shear_x = by_axis(direction[1], direction[2], direction[0]) * ray.scale_z;
  ray.shear_y = by_axis(direction[2], direction[0], direction[1]) * ray.scale_z;
  return ray;
}

[[nodiscard, gnu::always_inline]] inline PreparedRay prepare(const Ray& ray) {
  const float origin[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
  const float direction[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
  return prepare(origin, direction, ray.t_max);
}

[[nodiscard, gnu::always_inline]] inline Prepared<Float4> prepare(const Ray& a, const Ray& b,
                                                                  const Ray& c, const Ray& d) {
  const Transposed from = transposed(load4(&a.origin.x), load4(&b.origin.x), load4(&c.origin.x),
                                     load4(&d.origin.x));  // the fourth lane is t_max
  const Transposed to = transposed(load4(&a.direction.x), load4(&b.direction.x),
                                   load4(&c.direction.x), load4(&d.direction.x));
  const Float4 origin[3] = {from.x, from.y, from.z};
  const Float4 direction[3] = {to.x, to.y, to.z};
  return prepare(origin, direction, from.w);
}

// Ray k of four.
[[nodiscard]] inline PreparedRay extracted(const Prepared<Float4>& four, std::size_t k) {
  PreparedRay ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.inverse[axis] = four.inverse[axis][k];
    ray.near_offset[axis] = four.near_offset[axis][k];
    ray.far_offset[axis] = four.far_offset[axis][k];
    ray.origin[axis] = four.origin[axis][k];
  }
  ray.shear_x = four.shear_x[k];
  ray.shear_y = four.shear_y[k];
  ray.scale_z = four.scale_z[k];
  ray.z_axis = four.z_axis[k];
  ray.t_max = four.t_max[k];
  return ray;
}

}  // namespace pah
