// Rays that lean against the axis of a sun with a size: their ways across its grid, cell by cell.
#pragma once

#include "light_space/light_grid.hpp"

namespace pah {

// Rounded directions lean a little more than exact ones.
inline constexpr float leaning_allowance = 1 + 0x1p-10F;

// As LightGrid::occluded. Rays that lean more, or cross many cells, remain unknown.
void walk(const LightGrid& grid, const ParallelView& view, std::span<const Ray> rays,
          std::span<LightGrid::Answer> answers, TraversalCounts* counts);

}  // namespace pah
