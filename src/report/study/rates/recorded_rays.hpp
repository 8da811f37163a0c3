// The rays that a render of a scene asks.
#pragma once

#include <pah/accel/accelerator.hpp>
#include <pah/scene/world.hpp>

#include "report/study/rates/ray_batches.hpp"

namespace pah {

struct RecordedRays {
  RayBatches camera;
  RayBatches bounce;
  RayBatches shadow;                  // each batch by light, where lights are not too many
  RayBatches shadow_to_point_or_sun;  // those whose light has an exact bundle
};

// Renders some tiles of the picture, spread over it, on one thread, and listens. Tiles and samples
// are as many as send about `most` camera rays. Of other kinds no more than about as many are kept,
// in whole batches: those of the last kind without other rays. The seed chooses all.
[[nodiscard]] RecordedRays record_rays(const World& world, const Accelerator& accelerator,
                                       const FilmSettings& film, const RenderSettings& render,
                                       std::uint64_t most, std::uint64_t seed);

}  // namespace pah
