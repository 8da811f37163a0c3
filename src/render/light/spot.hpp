// Spots: point lights that shine within a cone, with a soft edge.
#pragma once

#include <pah/scene/light.hpp>

#include "render/light/light_sample.hpp"

namespace pah {

struct SpotEmitter {
  Vec3 position{0};
  Vec3 axis{0, -1, 0};
  Vec3 intensity{0};                   // W/sr, on the axis
  float cos_inner = 1, cos_outer = 1;  // full inside of the inner cone, dark outside of the outer
};

[[nodiscard]] SpotEmitter prepare(const SpotLight& light);
[[nodiscard]] std::optional<LightSample> sample(const SpotEmitter& emitter, const LitPoint& at,
                                                const LightNumbers& numbers);
[[nodiscard]] LightBounds bounds(const SpotEmitter& emitter);

}  // namespace pah
