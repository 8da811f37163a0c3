// Directional lights: parallel light, or a sun that covers a cone of directions.
#pragma once

#include <pah/scene/light.hpp>

#include "render/light/light_sample.hpp"

namespace pah {

struct DirectionalEmitter {
  Vec3 axis{0, 1, 0};       // towards the light
  Vec3 irradiance{0};       // W/m2, on a surface that faces the light
  float one_minus_cos = 0;  // of the half-angle; 0 for parallel light
  Vec3 radiance{0};         // W/(m2 sr); 0 for parallel light
};

[[nodiscard]] DirectionalEmitter prepare(const DirectionalLight& light);
[[nodiscard]] std::optional<LightSample> sample(const DirectionalEmitter& emitter,
                                                const LitPoint& at, const LightNumbers& numbers);
[[nodiscard]] DistantBounds bounds(const DirectionalEmitter& emitter);

// Whether a ray that leaves the scene may meet the light.
[[nodiscard]] bool is_visible_at_infinity(const DirectionalEmitter& emitter);
[[nodiscard]] Vec3 distant_radiance(const DirectionalEmitter& emitter, const Vec3& direction);
// The density per solid angle with which sample() draws the direction.
[[nodiscard]] float distant_pdf(const DirectionalEmitter& emitter, const LitPoint& at,
                                const Vec3& direction);

}  // namespace pah
