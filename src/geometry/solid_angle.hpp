#pragma once

#include <cmath>
#include <pah/geometry/vec.hpp>

namespace pah {

// The solid angle of the triangle a, b, c as seen from the origin, in [0, 2 pi]. `determinant` is
// |det(a, b, c)|, the distance of the triangle's plane times twice its area. If a signed
// determinant is passed, the angle has the same sign. Van Oosterom and Strackee, IEEE Trans.
// Biomed. Eng. 1983, eq. 8.
[[nodiscard]] inline double solid_angle(const DVec3& a, const DVec3& b, const DVec3& c,
                                        double determinant) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double denominator =
      la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
  return 2 * std::atan2(determinant, denominator);
}

}  // namespace pah
