#include "render/light/point.hpp"

#include <numbers>

namespace pah {

PointEmitter prepare(const PointLight& light) { return {Vec3(light.position), light.intensity}; }

std::optional<LightSample> sample(const PointEmitter& emitter, const LitPoint& at,
                                  const LightNumbers& /*numbers*/) {
  return sample_toward_point(emitter.position, at.position, emitter.intensity);
}

LightBounds bounds(const PointEmitter& emitter) {
  return point_bounds(emitter.position, Vec3(0, 0, 1), std::numbers::pi, std::numbers::pi / 2,
                      mean_of(emitter.intensity));
}

}  // namespace pah
