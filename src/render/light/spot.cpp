#include "render/light/spot.hpp"

#include <cmath>

namespace pah {

SpotEmitter prepare(const SpotLight& light) {
  const double angle = glm::radians(light.angle);
  return {Vec3(light.position), Vec3(glm::normalize(light.direction)), light.intensity,
          static_cast<float>(std::cos(angle * (1 - light.blend))),
          static_cast<float>(std::cos(angle))};
}

// The intensity falls off smoothly in the cosine, from the inner cone to the outer.
std::optional<LightSample> sample(const SpotEmitter& emitter, const LitPoint& at,
                                  const LightNumbers& /*numbers*/) {
  auto made = sample_toward_point(emitter.position, at.position, emitter.intensity);
  if (!made) return made;
  const float cosine = -glm::dot(made->direction, emitter.axis);
  if (cosine < emitter.cos_outer) {
    made.reset();
  } else if (cosine < emitter.cos_inner) {
    made->radiance *= glm::smoothstep(emitter.cos_outer, emitter.cos_inner, cosine);
  }
  return made;
}

LightBounds bounds(const SpotEmitter& emitter) {
  const double inner = std::acos(static_cast<double>(emitter.cos_inner));
  const double outer = std::acos(static_cast<double>(emitter.cos_outer));
  return point_bounds(emitter.position, emitter.axis, inner, outer - inner,
                      mean_of(emitter.intensity));
}

}  // namespace pah
