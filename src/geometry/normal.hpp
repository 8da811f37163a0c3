#pragma once

#include <pah/geometry/triangles.hpp>

namespace pah {

// Along the normal of the triangle a, b, c (counter-clockwise as seen from its tip), as long as
// twice the triangle's area.
[[nodiscard]] inline DVec3 scaled_normal(const DVec3& a, const DVec3& b, const DVec3& c) {
  return glm::cross(b - a, c - a);
}
[[nodiscard]] inline DVec3 scaled_normal(const Triangle& triangle) {
  return scaled_normal(DVec3(triangle.a), DVec3(triangle.b), DVec3(triangle.c));
}

}  // namespace pah
