// A ray made ready for box and triangle tests, and the slab test of boxes.
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
#include <array>
#include <cmath>
#include <limits>
#include <pah/geometry/aabb.hpp>
#include <pah/geometry/ray.hpp>

#include "geometry/float4.hpp"
#include "geometry/rounding.hpp"

namespace pah {

inline constexpr float box_padding = rounding_bound(42);
inline constexpr float smallest_component = 0x1p-27F;

struct PreparedRay {
  // The slab test: t = plane * inverse + offset.
  Float4 inverse{};
  Float4 near_offset{};
  Float4 far_offset{};

  // The triangle test: the axis of the largest component becomes z, a shear makes the ray z.
  float origin[3]{};  // along `axes`
  float shear_x = 0;
  float shear_y = 0;
  float scale_z = 0;

  float t_max = -1;  // no interval reaches below zero: such a ray hits nothing
  std::array<std::uint8_t, 3> axes{0, 1, 2};
};

// The directions that can be told from zero and infinity without losing digits, and how far from
// the world's origin they may start, in units of the direction. Others (and NaN) hit nothing.
inline constexpr float min_direction = 0x1p-100F;
inline constexpr float max_direction = 0x1p100F;
inline constexpr float max_origin = 0x1p99F;

[[nodiscard]] inline float largest_of(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

// The box of a triangle, or of several, as rays are to meet it. A box inside another stays inside.
[[nodiscard, gnu::always_inline]] inline float padding_of(const Aabb& box) {
  return box_padding * largest_of(glm::max(glm::abs(box.min), glm::abs(box.max)));
}
[[nodiscard, gnu::always_inline]] inline Aabb padded(const Aabb& box) {
  const float padding = padding_of(box);
  return {box.min - padding, box.max + padding};
}

// Inlined, as the rule is (ray_triangle.hpp).
[[nodiscard, gnu::always_inline]] inline PreparedRay prepare(const Ray& ray) {
  PreparedRay prepared;
  const Float4 origin = load4(&ray.origin.x);  // and t_max
  Float4 direction = load4(&ray.direction.x);
  direction[3] = 1;  // lest the bundle be divided by
  const Float4 size = abs(direction);
  const float largest = largest_of(size);
  const float far_away = largest_of(abs(origin));
  // Zero, or NaN where anything is not finite.
  const Float4 nothing = 0 * origin + 0 * direction;
  const bool usable = largest >= min_direction && largest <= max_direction &&
                      far_away <= max_origin * largest && ray.t_max > 0 &&
                      nothing[0] + nothing[1] + nothing[2] == 0;
  if (!usable) return prepared;

  constexpr float tiny = 2 * std::numeric_limits<float>::denorm_min();
  const Float4 inverse =
      1 / with_sign_of(max(size, splat(smallest_component * largest)), direction);
  const Float4 offset = -(origin * inverse);
  const Float4 widening = box_padding * far_away * abs(inverse) + tiny;
  prepared.inverse = inverse;
  prepared.near_offset = offset - widening;
  prepared.far_offset = offset + widening;

  const std::size_t z = size[0] == largest ? 0 : size[1] == largest ? 1 : 2;
  constexpr std::array<std::uint8_t, 5> cycle{0, 1, 2, 0, 1};
  const std::size_t x = cycle[z + 1];
  const std::size_t y = cycle[z + 2];
  prepared.axes = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y),
                   static_cast<std::uint8_t>(z)};
  prepared.origin[0] = origin[x];
  prepared.origin[1] = origin[y];
  prepared.origin[2] = origin[z];
  prepared.scale_z = inverse[z];
  prepared.shear_x = direction[x] * prepared.scale_z;
  prepared.shear_y = direction[y] * prepared.scale_z;
  prepared.t_max = std::min(ray.t_max, std::numeric_limits<float>::max());
  return prepared;
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
