// Orthonormal bases.
#pragma once

#include <cmath>
#include <pah/geometry/vec.hpp>

namespace pah {

// A right-handed orthonormal basis whose third column is the unit vector n. It is continuous except
// at n.z = 0 and never degenerates: there is no "up" vector that n could be parallel to. Duff et
// al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
template <typename Real>
[[nodiscard]] glm::mat<3, 3, Real> basis_about(const glm::vec<3, Real>& n) {
  const Real sign = std::copysign(Real{1}, n.z);
  const Real a = -1 / (sign + n.z);
  const Real b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

// As basis_about(), for a direction of any length but 0.
[[nodiscard]] inline DMat3 orthonormal_basis(const DVec3& direction) {
  return basis_about(glm::normalize(direction));
}

}  // namespace pah
