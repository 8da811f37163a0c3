#pragma once

#include <cmath>
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

// The unit normal of the side from which the vertices run counter-clockwise; zero if degenerate.
[[nodiscard]] inline Vec3 geometric_normal(const Triangle& triangle) {
  const DVec3 exact = scaled_normal(triangle);
  const Vec3 normal(exact);
  const float length2 = glm::dot(normal, normal);
  // Where float squares neither overflow nor lose digits.
  if (length2 > 0x1p-80F && length2 < 0x1p80F) return normal / std::sqrt(length2);
  const double length = glm::length(exact);
  return length > 0 ? Vec3(exact / length) : Vec3(0);
}

[[nodiscard]] inline double surface_area(const Triangle& triangle) {
  return 0.5 * glm::length(scaled_normal(triangle));
}

}  // namespace pah
