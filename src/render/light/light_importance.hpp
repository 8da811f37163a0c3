// Estimates what a light, or a group of lights, contributes to a point, from bounds.
//
// The estimate is an unoccluded irradiance, so choices by it do not depend on the unit of length.
// The bounds of a group are those of Pharr et al., Physically Based Rendering (4th ed.), 12.6.3.
#pragma once

#include <pah/geometry/aabb.hpp>
#include <span>

namespace pah {

// The point that is lit.
struct LitPoint {
  Vec3 position{0};
  Vec3 normal{0};          // of the shaded side, of unit length
  bool transmits = false;  // light from behind counts too
};

// The bounds of a light or a group: its box, and its cone of emission, which is full up to theta_o
// from the axis and fades within a further theta_e.
struct LightBounds {
  Aabb box;
  Vec3 axis{0, 0, 1};
  float cos_theta_o = 1;
  float cos_theta_e = 1;
  bool two_sided = false;
  float intensity = 0;  // W/sr at the brightest, mean of the channels
};

// Bounds a light without a size at `position`; angles in radians.
[[nodiscard]] LightBounds point_bounds(const Vec3& position, const Vec3& axis, double theta_o,
                                       double theta_e, float intensity);

// A light at infinity.
struct DistantBounds {
  Vec3 axis{0, 0, 1};  // towards the light, of unit length
  float cos_angle = 1, sin_angle = 0;
  float irradiance = 0;  // on a surface that faces it, mean of the channels
  bool everywhere = false;
};
// `angle` is half of its cone's, in radians; pi: light from everywhere.
[[nodiscard]] DistantBounds distant_bounds(const Vec3& axis, float angle, float irradiance);

// Estimates the irradiance in W/m2; zero only where no light arrives.
[[nodiscard]] float importance(const LightBounds& bounds, const LitPoint& at);
[[nodiscard]] float importance(const DistantBounds& bounds, const LitPoint& at);

// The number of floats that the estimate needs of a light's bounds. For several lights they are
// stored as a structure of arrays.
inline constexpr std::size_t packed_size = 12;
void pack(const LightBounds& bounds, std::size_t index, std::span<float> packed);

// Computes importance() for several lights at once, with the same bits.
void importances(std::span<const float> packed, const LitPoint& at, float* __restrict of_each);

}  // namespace pah
