#pragma once

#include <pah/geometry/triangles.hpp>

namespace pah {

// The normal of the triangle a, b, c, which is counter-clockwise as seen from the normal's tip. Its
// length is twice the triangle's area.
[[nodiscard]] inline DVec3 scaled_normal(const DVec3& a, const DVec3& b, const DVec3& c) {
  return glm::cross(b - a, c - a);
}
[[nodiscard]] inline DVec3 scaled_normal(const Triangle& triangle) {
  return scaled_normal(DVec3(triangle.a), DVec3(triangle.b), DVec3(triangle.c));
}

}  // namespace pah
