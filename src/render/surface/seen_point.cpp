#include "render/surface/seen_point.hpp"

#include "render/surface/shading_frame.hpp"
#include "render/surface/surface_interaction.hpp"

namespace pah {
namespace {

bool is_lit_by(const PointBundle& light, const SeenPoint& at) {
  const Vec3 away = at.point.position - light.eye;
  const float along = glm::dot(light.axis, away);
  const bool in_cone =
      light.sine >= 1 ||
      (along > 0 && along * along >= (1 - light.sine * light.sine) * glm::dot(away, away));
  return in_cone && glm::dot(at.side, away) < 0;
}
bool is_lit_by(const ParallelBundle& light, const SeenPoint& at) {
  return glm::dot(at.side, light.toward) > 0;
}

Ray spawn_to(const PointBundle& light, const SeenPoint& from, const Vec2& /*lean*/) {
  return spawn_segment(from.point, light.eye, 0, no_bundle);
}
Ray spawn_to(const ParallelBundle& light, const SeenPoint& from, const Vec2& lean) {
  if (lean == Vec2(0)) return spawn_ray(from.point, light.toward);
  const Vec2 across = light.tangent * lean;
  return spawn_ray(
      from.point,
      glm::normalize(make_frame(light.toward).world_from_local({across.x, across.y, 1})));
}

}  // namespace

SeenPoint seen_point(const World& world, const Ray& ray, const Hit& hit) {
  const SurfacePoint point = interact(world, hit).point;
  const bool behind = glm::dot(ray.direction, point.normal) > 0;
  return {point, behind ? -point.normal : point.normal};
}

bool is_lit(const SeenPoint& at, const ExactBundle& light) {
  return std::visit([&](const auto& rays) { return is_lit_by(rays, at); }, light);
}

Ray ray_to(const SeenPoint& from, const ExactBundle& light, std::uint32_t bundle,
           const Vec2& lean) {
  Ray ray = std::visit([&](const auto& rays) { return spawn_to(rays, from, lean); }, light);
  ray.bundle = bundle;
  return ray;
}

}  // namespace pah
