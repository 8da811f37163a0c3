// Orthonormal bases around a normal.
#pragma once

#include <pah/geometry/basis.hpp>

namespace pah {

// A right-handed basis whose z is the normal. BSDFs use its local directions.
struct ShadingFrame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  [[nodiscard]] Vec3 local_from_world(const Vec3& w) const {
    return {glm::dot(x, w), glm::dot(y, w), glm::dot(z, w)};
  }
  [[nodiscard]] Vec3 world_from_local(const Vec3& w) const { return x * w.x + y * w.y + z * w.z; }
};

// A basis about a unit normal, continuous but at z = 0 (Duff et al., JCGT 6(1), 2017).
[[nodiscard]] inline ShadingFrame make_frame(const Vec3& normal) {
  const glm::mat3 basis = basis_about(normal);
  return {basis[0], basis[1], normal};
}

// The basis whose x is as near as possible to `tangent`, of any length. Where the two are parallel
// or the tangent is zero or not finite: as above.
[[nodiscard]] ShadingFrame make_frame(const Vec3& normal, const Vec3& tangent);

}  // namespace pah
