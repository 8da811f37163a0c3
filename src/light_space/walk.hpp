// Rays that lean against the axis of a sun with a size: their ways across its grid, cell by cell.
#pragma once

#include "light_space/light_grid.hpp"

namespace pah {

// As LightGrid::occluded. Any ray toward the light's half of directions may be asked: those that
// lean by more than 45 degrees, or cross many cells, remain unknown.
void walk(const LightGrid& grid, const ParallelView& view, std::span<const Ray> rays,
          std::span<LightGrid::Answer> answers, TraversalCounts* counts);

}  // namespace pah
