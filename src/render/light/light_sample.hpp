// A sample of a light.
#pragma once

#include <cmath>
#include <optional>
#include <pah/geometry/triangles.hpp>

#include "geometry/rounding.hpp"
#include "render/light/light_importance.hpp"

namespace pah {

struct LightSample {
  Vec3 radiance{0};   // W/(m2 sr), arriving unless something is in between; W/m2 if delta
  Vec3 direction{0};  // towards the light, of unit length
  float pdf = 0;      // per solid angle; 1 if delta
  bool delta = false;
  bool distant = false;                  // at infinity: no target
  Vec3 target{0};                        // where the shadow segment ends,
  float target_error = 0;                // give or take this length
  std::uint32_t triangle = no_triangle;  // of an area light
  Vec2 barycentrics{0};
};

// The random numbers of a light sample: one for a discrete choice, two for a position or direction.
struct LightNumbers {
  float choice = 0;
  Vec2 point{0};
};

[[nodiscard]] inline float mean_of(const Vec3& color) { return (color.x + color.y + color.z) / 3; }

// The functions below, and all that sample a light, build the sample in place: copying a struct
// right after writing it stalls on store-to-load forwarding.

// A sample of a light without a size at `position`; nothing where that is `from` itself.
[[nodiscard]] inline std::optional<LightSample> sample_toward_point(const Vec3& position,
                                                                    const Vec3& from,
                                                                    const Vec3& intensity) {
  const Vec3 to_light = position - from;
  const float distance2 = glm::dot(to_light, to_light);
  std::optional<LightSample> made(std::in_place);
  if (!(distance2 > 0)) {
    made.reset();
    return made;
  }
  LightSample& sample = *made;
  sample.radiance = intensity / distance2;
  sample.direction = to_light / std::sqrt(distance2);
  sample.pdf = 1;
  sample.delta = true;
  sample.target = position;
  sample.target_error = rounding_bound(7) * glm::length(position);
  return made;
}

// A sample of a light at infinity.
[[nodiscard]] inline std::optional<LightSample> sample_toward_infinity(const Vec3& radiance,
                                                                       const Vec3& direction,
                                                                       float pdf) {
  std::optional<LightSample> made(std::in_place);
  LightSample& sample = *made;
  sample.radiance = radiance;
  sample.direction = direction;
  sample.pdf = pdf;
  sample.distant = true;
  return made;
}

}  // namespace pah
