// Triangulates polygons.
#pragma once

#include <pah/geometry/vec.hpp>
#include <span>
#include <vector>

namespace pah {

// Adds n - 2 triangles of corner numbers for n >= 3 corners, wound like the polygon. Concave
// polygons are cut at their ears, in quadratic time; polygons that cross themselves or are not flat
// get some triangulation.
void triangulate(std::span<const Vec3> corners, std::vector<UVec3>& triangles);

}  // namespace pah
