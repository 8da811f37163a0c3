// How near to a sun with a size its rays can meet anything.
#pragma once

#include "light_space/light_grid.hpp"

namespace pah {

// Fills in the tiles' `nearest`, once their cells have lists: the least depth in any tile that a
// ray from there, which leans by no more than the tangent, can reach.
void find_reach(LightGrid& grid, float tangent);

}  // namespace pah
