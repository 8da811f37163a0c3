// The slab test of boxes.
//
// A box is met from `near` to `far`: per axis, plane * inverse + offset, one multiply-add a plane.
// That is conservative only; which triangles are hit is for the rule of ray_triangle.hpp to say.
// What a box must do is to hold every hit of every triangle, or part of a triangle, inside it:
// near <= t <= far, whatever the rounding.
//
// Planes are padded for that. Let M be the largest distance along an axis from the ray's origin to
// a vertex of the triangle, u the unit roundoff, L the largest component of the direction d. The
// rule's t is such that origin + t d lies within 30 u M of a point of the triangle, along every
// axis (ray_triangle.hpp). The padding must cover that, and
//   1 u M: inverse, a reciprocal,
//   3 u M: plane * inverse, origin * inverse, offset, and their sum,
//   3 u M: small components (below).
// M is at most the largest coordinate A of the triangle's box and O of the origin, by magnitude,
// together. So a triangle's box is padded for its A when a structure is built, and the origin for
// its O when a ray is prepared (lower planes are seen from higher up, upper ones from lower):
// nothing is left to do per box, and what is far away does not widen what is near. Padding is
// rounded itself, and added to a coordinate: 3 u of the coordinate. box_padding leaves 2 u for
// terms of second order. Offsets are moved by two of the smallest floats, for products that
// underflow. A box around padded boxes needs no more: rounding is monotone.
//
// Components of less than smallest_component * L count as that much, lest products overflow. What
// is outside of a slab is thus met no later. What is inside leaves it no sooner than after
// 3 u M / (2^-27 L) = 24 M / L, when it has left the box along the largest axis. So no NaN can
// arise from finite input.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <pah/geometry/aabb.hpp>

#include "geometry/prepared_ray.hpp"

namespace pah {

[[nodiscard]] inline float largest_of(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

// The box of a triangle, or of several, as rays are to meet it. A box inside another stays inside.
[[nodiscard, gnu::always_inline]] inline float padding_of(const Aabb& box) {
  return box_padding * largest_of(glm::max(glm::abs(box.min), glm::abs(box.max)));
}
[[nodiscard, gnu::always_inline]] inline Aabb padded(const Aabb& box) {
  const float padding = padding_of(box);
  return {box.min - padding, box.max + padding};
}

// Where a ray is inside a padded box; empty if near > far. near >= 0.
struct SlabInterval {
  float near = 0;
  float far = std::numeric_limits<float>::infinity();
};

[[nodiscard, gnu::always_inline]] inline SlabInterval intersect_box(const PreparedRay& ray,
                                                                    const Aabb& box) {
  SlabInterval interval;
  for (int i = 0; i < 3; ++i) {
    const bool negative = std::signbit(ray.inverse[i]);
    const float first = negative ? box.max[i] : box.min[i];
    const float last = negative ? box.min[i] : box.max[i];
    interval.near = std::max(interval.near, first * ray.inverse[i] + ray.near_offset[i]);
    interval.far = std::min(interval.far, last * ray.inverse[i] + ray.far_offset[i]);
  }
  return interval;
}

}  // namespace pah
