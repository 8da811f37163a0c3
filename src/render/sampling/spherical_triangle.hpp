// Samples a triangle as seen from a point: uniformly in solid angle where that is well conditioned,
// uniformly over its surface elsewhere.
#pragma once

#include <pah/geometry/triangles.hpp>

namespace pah {

class SphericalTriangle {
 public:
  SphericalTriangle(const Triangle& triangle, const Vec3& from);

  // In [0, 2 pi] (Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 1983, eq. 8).
  [[nodiscard]] double solid_angle() const { return solid_angle_; }

  // Whether solid-angle sampling is used for a triangle that fills this solid angle: below, the
  // spherical excess cancels and area sampling is as good; above, the triangle is nearly a
  // half-space.
  [[nodiscard]] bool sampled_by_solid_angle() const;

  // Barycentric weights (of the second and third vertex) of a point whose direction is uniform in
  // solid angle. The order of choices is that of Arvo, "Stratified Sampling of Spherical Triangles"
  // (SIGGRAPH 1995). Only where it is so sampled.
  [[nodiscard]] Vec2 sample(const Vec2& u) const;

 private:
  DVec3 length_;        // of the vertices, as seen from the point
  DVec3 cosine_;        // between the directions to b and c, c and a, a and b
  double determinant_;  // of the three directions, without its sign
  double solid_angle_;
};

}  // namespace pah
