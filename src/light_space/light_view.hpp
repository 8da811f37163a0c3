// Coordinates of space as a light sees it: every ray of its bundle is one point there.
#pragma once

#include <pah/geometry/basis.hpp>
#include <pah/geometry/exact_bundle.hpp>

#include "light_space/range.hpp"

namespace pah {

// The view of a point light: the six faces of a cube around it. A point of space has a place (u, v)
// on a face, tangents from -1 to 1, and a depth: its distance from the light along the face's axis.
class CubeView {
 public:
  static constexpr int faces = 6;

  explicit CubeView(const PointBundle& bundle)
      : eye_(bundle.eye), axis_(bundle.axis), sine_(double{bundle.sine}) {}

  // A point in the axes of a face; the third is the axis perpendicular to the face.
  [[nodiscard]] DVec3 local(int face, const DVec3& point) const {
    const DVec3 w = point - DVec3(eye_);
    const int z = face % 3;
    return {w[(z + 1) % 3], w[(z + 2) % 3], face < 3 ? w[z] : -w[z]};
  }
  [[nodiscard]] const Vec3& eye() const { return eye_; }

  // Whether the bundle has rays of some directions only.
  [[nodiscard]] bool is_cone() const { return sine_ < 1; }
  // Bounds of the rays' tangents along the first or second axis of a face.
  [[nodiscard]] Interval limits(int face, int axis) const;

 private:
  Vec3 eye_;
  DVec3 axis_;  // of the cone of rays
  double sine_;
};

// The view of parallel rays: one face perpendicular to them, in units of length.
class ParallelView {
 public:
  static constexpr int faces = 1;

  ParallelView(const ParallelBundle& bundle, const Vec3& center)
      : toward_(bundle.toward),
        tangent_(bundle.tangent),
        center_(center),
        basis_(orthonormal_basis(DVec3(bundle.toward))),
        rounded_(basis_) {}

  [[nodiscard]] DVec3 local(int /*face*/, const DVec3& point) const {
    const DVec3 w = point - DVec3(center_);
    return {glm::dot(basis_[0], w), glm::dot(basis_[1], w), -glm::dot(basis_[2], w)};
  }
  // The axes of u, v and -depth.
  [[nodiscard]] const glm::mat3& axes() const { return rounded_; }
  [[nodiscard]] const Vec3& center() const { return center_; }
  [[nodiscard]] const Vec3& toward() const { return toward_; }
  // The tangent of the largest angle between a ray and toward().
  [[nodiscard]] float tangent() const { return tangent_; }

 private:
  Vec3 toward_;
  float tangent_;
  Vec3 center_;
  DMat3 basis_;
  glm::mat3 rounded_;
};

}  // namespace pah
