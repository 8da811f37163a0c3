// Chooses the tiles and cells of a light grid.
#pragma once

#include "light_space/light_grid.hpp"

namespace pah {

// Sets the grid's faces and tiles and allocates its cells: about `density` cells per triangle of
// the BVH, more where triangles are dense. `error` is that of outline.hpp.
void lay_out(LightGrid& grid, double density, double error);

}  // namespace pah
