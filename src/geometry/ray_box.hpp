// A ray made ready for box and triangle tests, and the slab test of boxes.
//
// Boxes of triangles are tested by one formula: per axis t_near = (near plane - its origin) *
// inverse and t_far likewise. Each operation rounds monotonically, so that a box inside another has
// an interval inside the other's TO THE LAST BIT. That is what makes culling exact; see
// ray_triangle.hpp for how the two tests become one rule. Nodes take a faster formula that is
// proven to be wider (below).
//
// Boxes are padded against rounding. With M the largest distance along an axis from the ray's
// origin to a corner of the triangle's box, the padding must cover
//   7 u M: sheared vertices of the triangle test (u = unit roundoff; ray_triangle.hpp), and
//   3 u M: the slab formula itself: difference, reciprocal, product. Ize ("Robust BVH Ray
//          Traversal", JCGT 2013) widens t_far for this; padding the planes covers both ends.
// M is at most the largest coordinate A of the box and O of the origin, by magnitude, together. So
// a triangle's box is padded for its A when a structure is built, and the origin for its O when a
// ray is prepared (lower planes are seen from higher up, upper ones from lower): nothing is left to
// do per box, and what is far away does not widen what is near. rounding_bound(11) leaves one u for
// terms of second order. Adding the padding to a coordinate, and computing it, rounds, too: 2 u of
// the coordinate more make up for that.
//
// A zero of the direction would give 0 * infinity; its inverse is the largest float instead, with
// the zero's sign. Either the origin is outside the padded slab (t_near is then huge: a miss) or it
// is inside by the last u M of the padding (t_far is huge). So no NaN can arise from finite input.
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

inline constexpr float triangle_padding = rounding_bound(13);
inline constexpr float origin_padding = rounding_bound(11);

// Nodes are tested in one step an axis instead of two: t = plane * inverse + offset, offset being
// -origin * inverse. That rounds otherwise, so it is widened until a node's interval holds that of
// every padded box inside it, for all that matters: near is no larger, and far no smaller wherever
// the box's interval is not empty. For a positive direction, with p a plane of the box, o the
// origin it is seen from and i the inverse, the box's near is fl(fl(p - o) * i) = fl(y) with
// y >= (p - o) i (1 - u) where that is above zero. The node's is fl(x): x is off from (p - o) i by
// u i (|p| + 2 |o|) at most (the product p * i rounds where there is no fused multiply-add; o's
// rounding and the offset's do), and by two of the smallest floats where products underflow. Planes
// and origins moved by rounding_bound(4) of themselves, 3 u after rounding, and offsets by those
// two floats make x <= (p - o) i - u i (|p| + |o|) <= y, hence fl(x) <= fl(y). Moved planes keep
// their order, so that a node's plane does for all boxes in it. far and negative directions are
// mirror images.
//
// Components of less than smallest_component of the largest, L, count as that much in nodes, lest
// products overflow. What is outside of a slab is thus met no later. What is inside leaves it no
// sooner than after 3 u (|p| + |o|) / (2^-27 L) = 24 (|p| + |o|) / L, when it has left the box
// along the largest axis.
inline constexpr float node_rounding = rounding_bound(4);
inline constexpr float smallest_component = 0x1p-27F;

struct PreparedRay {
  // The slab test of padded boxes.
  std::array<Float4, 2> plane_origin{};  // where lower planes are seen from, and upper ones
  Float4 inverse{};                      // 1 / direction, finite

  // The slab test of nodes: t = plane * node_inverse + offset, widened.
  Float4 node_inverse{};
  Float4 near_offset{};
  Float4 far_offset{};

  // The triangle test: the axis of the largest component becomes z, a shear makes the ray z.
  float origin[3]{};  // along `axes`
  float shear_x = 0;
  float shear_y = 0;
  float scale_z = 0;

  float t_max = -1;  // no interval reaches below zero: such a ray hits nothing
  std::array<std::uint8_t, 3> axes{0, 1, 2};

  // Whether upper planes are met first.
  [[nodiscard, gnu::always_inline]] bool negative(int axis) const { return inverse[axis] < 0; }
};

// The directions that can be told from zero and infinity without losing digits, and how far from
// the world's origin they may start, in units of the direction. Others (and NaN) hit nothing.
inline constexpr float min_direction = 0x1p-100F;
inline constexpr float max_direction = 0x1p100F;
inline constexpr float max_origin = 0x1p99F;

[[nodiscard]] inline float largest_of(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

// The box of a triangle, or of several, as rays are to meet it. A box inside another stays inside.
[[nodiscard, gnu::always_inline]] inline float padding_of(const Aabb& box) {
  return triangle_padding * largest_of(glm::max(glm::abs(box.min), glm::abs(box.max)));
}
[[nodiscard, gnu::always_inline]] inline Aabb padded(const Aabb& box) {
  const float padding = padding_of(box);
  return {box.min - padding, box.max + padding};
}

// A padded box as a node has it.
[[nodiscard]] inline Aabb node_box(const Aabb& box) {
  return {box.min - node_rounding * glm::abs(box.min), box.max + node_rounding * glm::abs(box.max)};
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

  constexpr float huge = std::numeric_limits<float>::max();
  constexpr float tiny = 2 * std::numeric_limits<float>::denorm_min();
  const Float4 pad = origin_padding * far_away + 2 * unit_roundoff * abs(origin);
  const Float4 low = origin + pad;
  const Float4 high = origin - pad;
  const Float4 inverse = min(max(1 / direction, splat(-huge)), splat(huge));
  const Float4 node_inverse =
      1 / with_sign_of(max(size, splat(smallest_component * largest)), direction);
  const Float4 low_offset = (low + node_rounding * abs(low)) * node_inverse;
  const Float4 high_offset = (high - node_rounding * abs(high)) * node_inverse;
  prepared.plane_origin = {low, high};
  prepared.inverse = inverse;
  prepared.node_inverse = node_inverse;
  // The lower plane is seen from higher up: it is met first where its offset is the larger one.
  prepared.near_offset = -max(low_offset, high_offset) - tiny;
  prepared.far_offset = tiny - min(low_offset, high_offset);

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
  prepared.t_max = std::min(ray.t_max, huge);
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
    const float low = (box.min[i] - ray.plane_origin[0][i]) * ray.inverse[i];
    const float high = (box.max[i] - ray.plane_origin[1][i]) * ray.inverse[i];
    const bool negative = ray.negative(i);
    interval.near = std::max(interval.near, negative ? high : low);
    interval.far = std::min(interval.far, negative ? low : high);
  }
  return interval;
}

}  // namespace pah
