// Numbers as colours.
#pragma once

#include <pah/render/film.hpp>

#include "report/ray_costs.hpp"

namespace pah {

// From black by blue, green and red to white, evenly growing in brightness: D. A. Green, "A colour
// scheme for the display of astronomical intensity images" (2011). `value` is in [0, 1]; the colour
// is linear.
[[nodiscard]] Vec3 false_colour(double value);

// Nodes visited on the left, triangles tested on the right, each from 0 to its maximum.
[[nodiscard]] Image heat_map(const PictureCosts& costs);

}  // namespace pah
