#include <pah/influence/influence_area.hpp>

#include <cmath>
#include <pah/geometry/basis.hpp>

namespace pah {

PlaneArea make_plane_area(const DVec3& position, const DVec3& direction, const DVec2& size,
                          double depth) {
  const DMat3 axes = orthonormal_basis(direction);
  return {{position + 0.5 * depth * axes[2], axes, 0.5 * DVec3(size, depth)}};
}

PointArea make_point_area(const DVec3& eye, const DVec3& forward, const DVec2& fov, double near,
                          double far, PointMeasure measure) {
  return {{eye, orthonormal_basis(forward), glm::tan(0.5 * fov), near, far}, measure};
}

Region region_of(const InfluenceArea& area) {
  if (const auto* plane = std::get_if<PlaneArea>(&area)) return plane->box;
  return std::get<PointArea>(area).frustum;
}

DVec3 ray_direction(const InfluenceArea& area, const DVec3& point) {
  if (const auto* plane = std::get_if<PlaneArea>(&area)) return plane->box.axes[2];
  const Frustum& frustum = std::get<PointArea>(area).frustum;
  const DVec3 away = point - frustum.eye;
  return away == DVec3(0) ? frustum.axes[2] : glm::normalize(away);
}

bool is_affine(const InfluenceArea& area, const Ray& ray, double tolerance) {
  if (const auto* point = std::get_if<PointArea>(&area))
    if (DVec3(ray.origin) == point->frustum.eye) return true;
  const DVec3 bundle = ray_direction(area, DVec3(ray.origin));
  const DVec3 direction(ray.direction);
  const double angle =
      std::atan2(glm::length(glm::cross(bundle, direction)), std::abs(glm::dot(bundle, direction)));
  return angle <= tolerance;
}

std::optional<DVec2> project(const InfluenceArea& area, const DVec3& point) {
  if (const auto* plane = std::get_if<PlaneArea>(&area)) {
    const DVec3 p = point - plane->box.center;
    return DVec2(glm::dot(plane->box.axes[0], p), glm::dot(plane->box.axes[1], p));
  }
  const Frustum& frustum = std::get<PointArea>(area).frustum;
  const DVec3 p = point - frustum.eye;
  const double depth = glm::dot(frustum.axes[2], p);
  if (!(depth > 0)) return std::nullopt;
  return DVec2(glm::dot(frustum.axes[0], p), glm::dot(frustum.axes[1], p)) / depth;
}

}  // namespace pah
