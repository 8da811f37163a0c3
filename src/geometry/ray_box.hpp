// The slab test of boxes.
//
// A ray is inside a box from `near` to `far`. Each plane takes one multiply-add, plane * inverse +
// offset. The test is conservative; the rule of ray_triangle.hpp decides which triangles are hit.
// The interval must hold every hit of every triangle, or part of a triangle, inside the box: near
// <= t <= far, whatever the rounding.
//
// Padded planes ensure that. Let M be the largest distance along an axis from the ray's origin to a
// vertex of the triangle, u the unit roundoff, L the largest component of the direction d. For the
// rule's t, origin + t d lies within 30 u M of a point of the triangle along every axis
// (ray_triangle.hpp). The padding must cover that, and
//   1 u M: inverse, a reciprocal,
//   3 u M: plane * inverse, origin * inverse, offset, and their sum,
//   3 u M: small components (below).
// M is at most A + O, where A is the largest absolute coordinate of the triangle's box and O that
// of the origin. So a triangle's box is padded for its A when a structure is built, and the origin
// for its O when a ray is prepared (near planes are moved towards the ray, far planes away from
// it). A box test then needs no extra work, and distant geometry does not widen near boxes. The
// padding itself is rounded and added to a coordinate: 3 u of the coordinate. box_padding leaves 2
// u for terms of second order. Offsets are also moved by two of the smallest floats, for products
// that underflow. A box around padded boxes needs no more padding: rounding is monotone.
//
// Components below smallest_component * L are enlarged to that, so that products do not overflow. A
// ray outside of a slab thus enters it no later. A ray inside of it leaves it no sooner than after
// 3 u M / (2^-27 L) = 24 M / L, when it has left the box along the largest axis. So finite input
// never makes NaN.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <pah/geometry/aabb.hpp>

#include "geometry/prepared_ray.hpp"

namespace pah {

[[nodiscard]] inline float largest_of(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

// The largest absolute coordinate of a box.
[[nodiscard, gnu::always_inline]] inline float magnitude_of(const Aabb& box) {
  return largest_of(glm::max(glm::abs(box.min), glm::abs(box.max)));
}
// Pads a box around triangles. A box inside another one is still inside it when both are padded.
[[nodiscard, gnu::always_inline]] inline Aabb padded(const Aabb& box) {
  const float padding = box_padding * magnitude_of(box);
  return {box.min - padding, box.max + padding};
}

// The part of a ray inside a padded box; empty if near > far. near >= 0. Real is float, or Float4
// for four boxes.
template <typename Real>
struct SlabIntervalOf {
  Real near = Real{};
  Real far = Real{} + std::numeric_limits<float>::infinity();
};
using SlabInterval = SlabIntervalOf<float>;

template <typename Real>
[[nodiscard, gnu::always_inline]] inline SlabIntervalOf<Real> intersect_slabs(
    const PreparedRay& ray, const Real (&box_min)[3], const Real (&box_max)[3]) {
  SlabIntervalOf<Real> interval;
  for (int i = 0; i < 3; ++i) {
    const bool negative = std::signbit(ray.inverse[i]);
    const Real& first = negative ? box_max[i] : box_min[i];
    const Real& last = negative ? box_min[i] : box_max[i];
    interval.near = max(first * ray.inverse[i] + ray.near_offset[i], interval.near);
    interval.far = min(last * ray.inverse[i] + ray.far_offset[i], interval.far);
  }
  return interval;
}

[[nodiscard, gnu::always_inline]] inline SlabInterval intersect_box(const PreparedRay& ray,
                                                                    const Aabb& box) {
  return intersect_slabs<float>(ray, {box.min.x, box.min.y, box.min.z},
                                {box.max.x, box.max.y, box.max.z});
}

}  // namespace pah
