// Numbers as colors.
#pragma once

#include <pah/geometry/vec.hpp>
#include <pah/image/image.hpp>

#include "report/inspect/ray_costs.hpp"

namespace pah {

// From black by blue, green and red to white, evenly growing in brightness: D. A. Green, "A colour
// scheme for the display of astronomical intensity images" (2011). `value` is in [0, 1]; the color
// is linear.
[[nodiscard]] Vec3 false_color(double value);

// Nodes visited on the left, triangles tested on the right, each from 0 to its maximum.
[[nodiscard]] Image heat_map(const PictureCosts& costs);

}  // namespace pah
