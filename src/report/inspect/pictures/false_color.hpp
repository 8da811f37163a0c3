// Numbers as colors.
#pragma once

#include <pah/geometry/vec.hpp>
#include <pah/image/image.hpp>

#include "report/inspect/ray_costs.hpp"

namespace pah {

// Maps [0, 1] to linear colors from black through blue, green and red to white, with steadily
// growing brightness: D. A. Green, "A colour scheme for the display of astronomical intensity
// images" (2011).
[[nodiscard]] Vec3 false_color(double value);

// Draws visited nodes on the left and tested triangles on the right, each from 0 to its maximum.
[[nodiscard]] Image heat_map(const PictureCosts& costs);

}  // namespace pah
