// The least depth at which rays to a sun with an angular size can hit anything.
#pragma once

#include "light_space/light_grid.hpp"

namespace pah {

// Sets every tile's `nearest`: the least depth in any tile that a ray from this tile can reach if
// it is tilted by no more than `tangent`. The cells must have their lists already.
void find_reach(LightGrid& grid, float tangent);

}  // namespace pah
