// Makes rays that start and end on surfaces without meeting them again, by error bounds instead of
// a constant epsilon. After Pharr, Jakob & Humphreys, Physically Based Rendering (4th ed.), 6.8.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <pah/geometry/ray.hpp>

#include "geometry/rounding.hpp"

namespace pah {

// The neighboring floats; x is finite.
inline float next_float_up(float x) {
  if (x == 0) return std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return std::bit_cast<float>(x > 0 ? bits + 1 : bits - 1);
}
inline float next_float_down(float x) { return -next_float_up(-x); }

// A point on a surface, rounded: the true one lies within `error` of it, per axis.
struct SurfacePoint {
  Vec3 position{0};
  Vec3 error{0};
  Vec3 normal{0};  // geometric, of unit length
};

// The point moved off the surface to the side that `direction` points to: along the normal until
// the box of errors is wholly on that side, rounded outward.
inline Vec3 offset_point(const SurfacePoint& point, const Vec3& direction) {
  const float distance = glm::dot(glm::abs(point.normal), point.error);
  const bool inside = glm::dot(direction, point.normal) < 0;
  const Vec3 offset = (inside ? -distance : distance) * point.normal;
  Vec3 moved = point.position + offset;
  for (int axis = 0; axis < 3; ++axis) {
    if (offset[axis] > 0) {
      moved[axis] = next_float_up(moved[axis]);
    } else if (offset[axis] < 0) {
      moved[axis] = next_float_down(moved[axis]);
    }
  }
  return moved;
}

// Where a facet stands for a curved surface, a ray may start on the side of the facet that `side`
// points to, whatever its own direction.
inline Ray spawn_ray(const SurfacePoint& from, const Vec3& direction, const Vec3& side) {
  return {offset_point(from, side), std::numeric_limits<float>::infinity(), direction, no_bundle};
}
inline Ray spawn_ray(const SurfacePoint& from, const Vec3& direction) {
  return spawn_ray(from, direction, direction);
}

// The segment from a surface to `target`, which is exact to within `target_error` (a length). It
// ends short of the target by that error and by the rounding of the direction, both in units of
// the segment's length.
inline Ray spawn_segment(const SurfacePoint& from, const Vec3& target, float target_error,
                         std::uint32_t bundle, const Vec3& side) {
  const Vec3 origin = offset_point(from, side);
  const Vec3 direction = target - origin;
  const float length = glm::length(direction);
  const float shortening = rounding_bound(8) + (length > 0 ? target_error / length : 1.0F);
  return {origin, std::fmax(0.0F, 1.0F - shortening), direction, bundle};
}
inline Ray spawn_segment(const SurfacePoint& from, const Vec3& target, float target_error,
                         std::uint32_t bundle) {
  return spawn_segment(from, target, target_error, bundle, target - from.position);
}

}  // namespace pah
