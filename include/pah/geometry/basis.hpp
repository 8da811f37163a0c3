// Orthonormal bases.
#pragma once

#include <cmath>
#include <pah/geometry/vec.hpp>

namespace pah {

// A right-handed orthonormal basis whose third column is `direction`, of any length but 0. It never
// degenerates: there is no "up" that the direction could be parallel to.
// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
[[nodiscard]] inline DMat3 orthonormal_basis(const DVec3& direction) {
  const DVec3 n = glm::normalize(direction);
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

}  // namespace pah
