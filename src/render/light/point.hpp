// Point lights: the same intensity in every direction, from a point.
#pragma once

#include <pah/scene/light.hpp>

#include "render/light/light_sample.hpp"

namespace pah {

struct PointEmitter {
  Vec3 position{0};
  Vec3 intensity{0};  // W/sr
};

[[nodiscard]] PointEmitter prepare(const PointLight& light);
[[nodiscard]] std::optional<LightSample> sample(const PointEmitter& emitter, const LitPoint& at,
                                                const LightNumbers& numbers);
[[nodiscard]] LightBounds bounds(const PointEmitter& emitter);

}  // namespace pah
