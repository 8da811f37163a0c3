// Triangulation of polygons.
#pragma once

#include <pah/geometry/vec.hpp>
#include <span>
#include <vector>

namespace pah {

// Cuts a polygon of n >= 3 corners into n - 2 triangles with its winding. `triangles` receives
// indices of corners. Clips the ears of concave polygons, which takes O(n^2) time. Polygons that
// cross themselves or are not flat get an arbitrary triangulation.
void triangulate(std::span<const Vec3> corners, std::vector<UVec3>& triangles);

}  // namespace pah
