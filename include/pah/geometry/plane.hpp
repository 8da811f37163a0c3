// Planes, and their intersections with rays.
#pragma once

#include <optional>
#include <pah/geometry/ray.hpp>

namespace pah {

// The points p with dot(normal, p) + offset = 0. The normal may have any length but 0. If its
// length is 1, dot(normal, p) + offset is the signed distance of p from the plane, positive on the
// side to which the normal points.
struct Plane {
  DVec3 normal{0, 0, 1};
  double offset = 0;
};

[[nodiscard]] inline Plane plane_through(const DVec3& point, const DVec3& normal) {
  return {normal, -glm::dot(normal, point)};
}

// The t in (0, t_max] at which a ray crosses a plane, in units of the ray's direction, rounded to
// double. Nothing for a ray parallel to the plane, even within it, and nothing if the ray starts on
// the plane. Thesis, A.2: algorithm A.2 omits the offset, and the formula before it has its sign
// wrong.
[[nodiscard]] inline std::optional<double> intersection(const Plane& plane, const Ray& ray) {
  const double slope = glm::dot(plane.normal, DVec3(ray.direction));
  if (slope == 0) return {};
  const double t = -(glm::dot(plane.normal, DVec3(ray.origin)) + plane.offset) / slope;
  if (t > 0 && t <= double{ray.t_max}) return t;
  return {};
}

}  // namespace pah
