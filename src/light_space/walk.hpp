// Rays to a sun with an angular size are tilted against the grid's axis: each is a segment in the
// sun's view, and walk() looks it up in every cell that it crosses.
#pragma once

#include "light_space/light_grid.hpp"

namespace pah {

// A rounded direction may be tilted slightly more than the exact one.
inline constexpr float tangent_allowance = 1 + 0x1p-10F;

// As LightGrid::occluded(). Rays that are tilted more or cross too many cells remain unknown.
void walk(const LightGrid& grid, const ParallelView& view, std::span<const Ray> rays,
          std::span<LightGrid::Answer> answers, TraversalCounts* counts);

}  // namespace pah
