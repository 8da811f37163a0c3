// Planes, and where rays cross them.
#pragma once

#include <optional>
#include <pah/geometry/ray.hpp>

namespace pah {

// The points p with dot(normal, p) + offset = 0. The normal is of any length but 0; if it is 1,
// dot(normal, p) + offset is how far p lies from the plane on the side that the normal points to.
struct Plane {
  DVec3 normal{0, 0, 1};
  double offset = 0;
};

[[nodiscard]] inline Plane plane_through(const DVec3& point, const DVec3& normal) {
  return {normal, -glm::dot(normal, point)};
}

// The t in (0, t_max] at which a ray crosses a plane, in units of the ray's direction; rounded, in
// double. Nothing for a ray along the plane, not even one within it: there is no one point to name,
// as none is where a ray lies in a triangle's plane. Nothing if the ray starts on the plane.
// Thesis, A.2, where algorithm A.2 forgets the offset and the formula before it the sign of it.
[[nodiscard]] inline std::optional<double> intersection(const Plane& plane, const Ray& ray) {
  const double slope = glm::dot(plane.normal, DVec3(ray.direction));
  if (slope == 0) return {};
  const double t = -(glm::dot(plane.normal, DVec3(ray.origin)) + plane.offset) / slope;
  if (t > 0 && t <= double{ray.t_max}) return t;
  return {};
}

}  // namespace pah
