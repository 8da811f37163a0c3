// Rays that start and end on surfaces without meeting them again: error bounds carried along, never
// a constant epsilon. After Pharr, Jakob & Humphreys, Physically Based Rendering (4th ed.), 6.8.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <pah/geometry/ray.hpp>

#include "geometry/float4.hpp"
#include "geometry/rounding.hpp"

namespace pah {

// A point on a surface, rounded: the true one lies within `error` of it, per axis.
struct SurfacePoint {
  Vec3 position{0};
  Vec3 error{0};
  Vec3 normal{0};  // geometric, of unit length
};

// The point moved off the surface to the side that `direction` points to: along the normal until
// the box of errors is wholly on that side, rounded outward.
inline Vec3 offset_point(const SurfacePoint& point, const Vec3& direction) {
  const Float4 normal = float4(point.normal);
  const float distance = glm::dot(glm::abs(point.normal), point.error);
  const bool inside = glm::dot(direction, point.normal) < 0;
  const Float4 offset = splat(inside ? -distance : distance) * normal;
  const Float4 moved = float4(point.position) + offset;
  // The neighbor in the offset's direction is one more or one less as an integer: of a zero that
  // has the offset's sign, one more.
  const Int4 sign = Int4{} + std::int32_t{-0x7FFFFFFF - 1};
  const Int4 toward = std::bit_cast<Int4>(offset) & (offset != 0.0F);
  const Int4 bits = std::bit_cast<Int4>(moved) & (moved != 0.0F);
  const Int4 from = bits | (toward & sign & (moved == 0.0F));
  const Int4 step = (((from ^ toward) >> 31) | 1) & (offset != 0.0F);
  const Float4 rounded = std::bit_cast<Float4>(from + step);
  return {rounded[0], rounded[1], rounded[2]};
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
