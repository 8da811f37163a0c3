// How the light of a bundle sees space: every ray of the bundle is a point there.
#pragma once

#include <cmath>
#include <pah/geometry/basis.hpp>
#include <pah/geometry/exact_bundle.hpp>

namespace pah {

// A place as the light sees it: where on a face, and how far from the light, along the face's axis.
struct LightPoint {
  double u, v, depth;
};

// The light's view of space: the six faces of a cube about a point, each with tangents from -1 to
// 1, or for parallel rays one plane across them, in units of length.
class CubeView {
 public:
  static constexpr int faces = 6;

  explicit CubeView(const PointBundle& bundle) : eye_(bundle.eye) {}

  // Along the axes of a face, the third being the one that the face is across.
  [[nodiscard]] DVec3 local(int face, const DVec3& point) const {
    const DVec3 w = point - eye_;
    const int z = face % 3;
    return {w[(z + 1) % 3], w[(z + 2) % 3], face < 3 ? w[z] : -w[z]};
  }
  // Of a point other than the eye.
  [[nodiscard]] int face_of(const DVec3& point) const {
    const DVec3 w = point - eye_;
    const DVec3 size = glm::abs(w);
    const int z = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return w[z] < 0 ? z + 3 : z;
  }
  [[nodiscard]] static LightPoint seen(const DVec3& local) {
    return {local.x / local.z, local.y / local.z, local.z};
  }
  [[nodiscard]] bool holds(const Ray& ray) const {
    return ray.t_max <= 1 && Vec3(eye_) - ray.origin == ray.direction;
  }

 private:
  DVec3 eye_;  // floats all
};

class ParallelView {
 public:
  static constexpr int faces = 1;

  explicit ParallelView(const ParallelBundle& bundle)
      : toward_(bundle.toward), basis_(orthonormal_basis(DVec3(bundle.toward))) {}

  [[nodiscard]] DVec3 local(int /*face*/, const DVec3& point) const {
    return {glm::dot(basis_[0], point), glm::dot(basis_[1], point), -glm::dot(basis_[2], point)};
  }
  [[nodiscard]] static int face_of(const DVec3& /*point*/) { return 0; }
  [[nodiscard]] static LightPoint seen(const DVec3& local) { return {local.x, local.y, local.z}; }
  [[nodiscard]] bool holds(const Ray& ray) const { return ray.direction == toward_; }

 private:
  Vec3 toward_;
  DMat3 basis_;
};

}  // namespace pah
