// A few paths before a picture: what its shadow rays are like, and how many there will be.
#pragma once

#include <pah/accel/accelerator.hpp>
#include <pah/geometry/exact_bundle.hpp>
#include <pah/scene/scene.hpp>
#include <pah/scene/world.hpp>
#include <vector>

namespace pah {

struct PilotLight {
  LightId light = 0;
  ExactBundle rays;
};

// Shadow rays to one light, in the order in which a render sends them.
struct PilotRays {
  std::vector<Ray> rays;
  double expected = 0;  // in the whole render
};

// Of each light. Surfaces are taken for white and diffuse, and lights to get equal shares: no
// texture is read, and no material asked. The same for the same scene.
[[nodiscard]] std::vector<PilotRays> pilot_rays(const World& world, const Scene& settings,
                                                const Accelerator& accelerator,
                                                const std::vector<PilotLight>& lights);

}  // namespace pah
