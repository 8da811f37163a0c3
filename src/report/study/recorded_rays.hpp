// The rays that a render of a scene asks.
#pragma once

#include <pah/accel/accelerator.hpp>
#include <pah/scene/world.hpp>

#include "report/study/ray_batches.hpp"

namespace pah {

struct RecordedRays {
  RayBatches camera;
  RayBatches bounce;
  RayBatches shadow;
};

// A film of the same shape and as few samples as send about `camera_rays`.
void make_small(FilmSettings& film, RenderSettings& render, std::uint64_t camera_rays);

// Renders on one thread and listens. Of each kind no more than about `most` rays are kept, in whole
// batches that the seed chooses.
[[nodiscard]] RecordedRays record_rays(const World& world, const Accelerator& accelerator,
                                       const FilmSettings& film, const RenderSettings& render,
                                       std::uint64_t most, std::uint64_t seed);

}  // namespace pah
