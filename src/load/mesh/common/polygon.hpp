// Polygons into triangles.
#pragma once

#include <pah/geometry/vec.hpp>
#include <span>
#include <vector>

namespace pah {

// Three corners or more, n - 2 triangles of their numbers into `triangles`, wound like the polygon.
// Concave polygons are cut at their ears; what crosses itself or is not flat gives some
// triangulation. Takes time with the square of the corners, if they are concave.
void triangulate(std::span<const Vec3> corners, std::vector<UVec3>& triangles);

}  // namespace pah
