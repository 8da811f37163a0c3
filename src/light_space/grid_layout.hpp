// How fine the cells of a light's grid are, and where.
#pragma once

#include "light_space/light_grid.hpp"

namespace pah {

// Fills in the faces, the tiles and room for their cells: `density` cells, about, for each triangle
// of the BVH, more where it has more of them. `error` is that of outline.hpp.
void lay_out(LightGrid& grid, double density, double error);

}  // namespace pah
