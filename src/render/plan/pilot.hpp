// Traces a few paths before a render, to learn the kind and number of its shadow rays.
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

// Returns the rays to each light; the same for the same scene. Surfaces count as white and diffuse,
// and lights get equal shares, so no texture and no material is read.
[[nodiscard]] std::vector<PilotRays> pilot_rays(const World& world, const Scene& settings,
                                                const Accelerator& accelerator,
                                                const std::vector<PilotLight>& lights);

}  // namespace pah
