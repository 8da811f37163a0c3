// Rays, hits and the bundles that rays belong to.
#pragma once

#include <cstdint>
#include <limits>
#include <pah/geometry/vec.hpp>

namespace pah {

// A bundle is a set of rays that share a point or a direction: the shadow segments to one light,
// or the rays of a pinhole camera. Bundle i < number of lights is light i of the World.
inline constexpr std::uint32_t no_bundle = 0xFFFFFFFFU;
inline constexpr std::uint32_t camera_bundle = 0xFFFFFFFEU;

// The points origin + t * direction, 0 < t <= t_max. The direction need not be of unit length: a
// shadow segment to a point has direction = point - origin and t_max just under 1, a ray to the
// sun has t_max = infinity. `bundle` is a hint that changes speed, never the answer.
struct Ray {
  Vec3 origin{0};
  float t_max = std::numeric_limits<float>::infinity();
  Vec3 direction{0, 0, 1};
  std::uint32_t bundle = no_bundle;
};

inline constexpr std::uint32_t no_triangle = 0xFFFFFFFFU;

// The nearest intersection. Of equal distances, the lower triangle index wins.
struct Hit {
  float t = std::numeric_limits<float>::infinity();
  float u = 0;  // barycentric weight of the triangle's second vertex, in [0, 1]
  float v = 0;  // barycentric weight of its third vertex; u + v <= 1 up to rounding
  std::uint32_t triangle = no_triangle;

  [[nodiscard]] bool valid() const { return triangle != no_triangle; }
};

}  // namespace pah
