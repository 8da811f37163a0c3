// A ray made ready for box and triangle tests, and the slab test of boxes.
//
// All boxes of a scene are tested by one formula: per axis t_near = (near plane - near_origin) *
// inverse and t_far likewise. Each operation rounds monotonically, so that a box inside another has
// an interval inside the other's TO THE LAST BIT. That is what makes culling exact; see
// ray_triangle.hpp for how the two tests become one rule.
//
// Boxes are padded against rounding. With M the largest distance along an axis from the ray's
// origin to a corner of the triangle's box, the padding must cover
//   7 u M: sheared vertices of the triangle test (u = unit roundoff; ray_triangle.hpp), and
//   3 u M: the slab formula itself: difference, reciprocal, product. Ize ("Robust BVH Ray
//          Traversal", JCGT 2013) widens t_far for this; padding the planes covers both ends.
// M is at most the largest coordinate A of the box and O of the origin, by magnitude, together. So
// a triangle's box is padded for its A when a structure is built, and the origin for its O when a
// ray is prepared (near planes are seen from further along the direction, far planes from further
// back): nothing is left to do per box, and what is far away does not widen what is near.
// rounding_bound(11) leaves one u for terms of second order. Adding the padding to a coordinate,
// and computing it, rounds, too: 2 u of the coordinate more make up for that.
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

#include "geometry/rounding.hpp"

namespace pah {

struct PreparedRay {
  // The slab test.
  Vec3 near_origin{0};
  Vec3 far_origin{0};
  Vec3 inverse{0};                         // 1 / direction, finite
  std::array<std::uint8_t, 3> negative{};  // 1 where the direction is below zero (or -0)

  // The triangle test: the axis of the largest component becomes z, a shear makes the ray z.
  std::array<std::uint8_t, 3> axes{0, 1, 2};
  Vec3 origin{0};
  float shear_x = 0;
  float shear_y = 0;
  float scale_z = 0;

  float t_max = -1;  // no interval reaches below zero: such a ray hits nothing
};

// The directions that can be told from zero and infinity without losing digits. Others (and NaN)
// hit nothing.
inline constexpr float min_direction = 0x1p-100F;
inline constexpr float max_direction = 0x1p100F;

[[nodiscard]] inline float largest_of(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

// The box of a triangle, or of several, as rays are to meet it. A box inside another stays inside.
[[nodiscard]] inline Aabb padded(const Aabb& box) {
  const float padding =
      rounding_bound(13) * largest_of(glm::max(glm::abs(box.min), glm::abs(box.max)));
  return {box.min - padding, box.max + padding};
}

[[nodiscard]] inline PreparedRay prepare(const Ray& ray) {
  PreparedRay prepared;
  const Vec3 size = glm::abs(ray.direction);
  const float largest = largest_of(size);
  // A sum is NaN if any summand is, and infinite or NaN if any is infinite.
  const bool usable = size.x + size.y + size.z <= 3 * max_direction && largest >= min_direction &&
                      std::isfinite(ray.origin.x) && std::isfinite(ray.origin.y) &&
                      std::isfinite(ray.origin.z) && ray.t_max > 0;
  if (!usable) return prepared;

  const float padding = rounding_bound(11) * largest_of(glm::abs(ray.origin));
  for (int i = 0; i < 3; ++i) {
    const float huge = std::numeric_limits<float>::max();
    const float inverse = std::clamp(1.0F / ray.direction[i], -huge, huge);
    const float pad = std::copysign(padding + 2 * unit_roundoff * std::abs(ray.origin[i]), inverse);
    prepared.inverse[i] = inverse;
    prepared.negative[i] = inverse < 0 ? 1 : 0;
    prepared.near_origin[i] = ray.origin[i] + pad;
    prepared.far_origin[i] = ray.origin[i] - pad;
  }

  const std::uint8_t z = size.x == largest ? 0 : size.y == largest ? 1 : 2;
  const std::uint8_t x = z == 2 ? 0 : z + 1;
  const std::uint8_t y = z == 0 ? 2 : z - 1;
  prepared.axes = {x, y, z};
  prepared.origin = ray.origin;
  prepared.scale_z = prepared.inverse[z];
  prepared.shear_x = ray.direction[x] * prepared.scale_z;
  prepared.shear_y = ray.direction[y] * prepared.scale_z;
  prepared.t_max = std::min(ray.t_max, std::numeric_limits<float>::max());
  return prepared;
}

// Where a ray is inside a padded box; empty if near > far. near >= 0.
struct SlabInterval {
  float near = 0;
  float far = std::numeric_limits<float>::infinity();
};

[[nodiscard]] inline SlabInterval intersect_box(const PreparedRay& ray, const Aabb& box) {
  SlabInterval interval;
  for (int i = 0; i < 3; ++i) {
    const bool negative = ray.negative[i] != 0;
    const float near = (negative ? box.max[i] : box.min[i]) - ray.near_origin[i];
    const float far = (negative ? box.min[i] : box.max[i]) - ray.far_origin[i];
    interval.near = std::max(interval.near, near * ray.inverse[i]);
    interval.far = std::min(interval.far, far * ray.inverse[i]);
  }
  return interval;
}

}  // namespace pah
