// Records the rays of a render.
#pragma once

#include <pah/accel/accelerator.hpp>
#include <pah/scene/world.hpp>

#include "report/study/rates/ray_batches.hpp"

namespace pah {

struct RecordedRays {
  RayBatches camera;
  RayBatches bounce;
  RayBatches shadow;  // each batch sorted by light, unless there are too many lights
  RayBatches shadow_to_point_or_sun;  // those whose light has an exact bundle
};

// Renders some tiles across the picture on one thread and records their rays. Tiles and samples are
// chosen for about `most` camera rays; at most about as many rays of each other kind are kept, in
// whole batches. The seed determines all choices.
[[nodiscard]] RecordedRays record_rays(const World& world, const Accelerator& accelerator,
                                       const FilmSettings& film, const RenderSettings& render,
                                       std::uint64_t most, std::uint64_t seed);

}  // namespace pah
