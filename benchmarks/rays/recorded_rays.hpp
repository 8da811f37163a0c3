// The rays that the path tracer sends, as it sends them.
#pragma once

#include <pah/geometry/ray.hpp>
#include <vector>

#include "meshes.hpp"

namespace pah::bench {

// One vector a call of the accelerator.
using RayBatches = std::vector<std::vector<Ray>>;

struct RecordedRays {
  RayBatches camera;
  RayBatches bounce;
  RayBatches to_bulb;
  RayBatches to_sun;
  RayBatches to_spot;
};

// Renders the scene and listens.
[[nodiscard]] RecordedRays record_rays(const MeshScene& scene);

}  // namespace pah::bench
