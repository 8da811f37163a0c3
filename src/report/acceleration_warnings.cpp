#include "report/acceleration_warnings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <variant>

#include "base/format_bytes.hpp"

namespace pah {
namespace {

struct Cone {
  DVec3 axis;    // of unit length
  double angle;  // between the axis and its outermost rays, in radians
};

Cone cone_of(const Frustum& frustum) {
  return {frustum.axes[2], std::atan(glm::length(frustum.tan_half))};
}

// Returns a cone around the rays of a bundle that meet in a point; nothing if they go everywhere.
std::optional<Cone> bundle_cone(const World& world, const FilmSettings& film,
                                std::uint32_t bundle) {
  if (bundle != camera_bundle) {
    const auto* spot = std::get_if<SpotLight>(&world.lights[bundle].model);
    if (spot == nullptr) return std::nullopt;
    return Cone{glm::normalize(spot->direction), glm::radians(spot->angle)};
  }
  const auto* camera = std::get_if<PerspectiveCamera>(&world.camera);
  if (camera == nullptr) return std::nullopt;
  const double half_height = std::tan(glm::radians(camera->fov) / 2);
  return Cone{glm::normalize(camera->look_at - camera->position),
              std::atan(half_height * std::hypot(1.0, double(film.width) / film.height))};
}

// Certain, because the cones hold more than the rays and the area.
bool are_apart(const Cone& a, const Cone& b) {
  const double between =
      std::atan2(glm::length(glm::cross(a.axis, b.axis)), glm::dot(a.axis, b.axis));
  return between > a.angle + b.angle;
}

bool no_ray_enters(const SceneArea& area, const World& world, const FilmSettings& film) {
  const auto* point = std::get_if<PointArea>(&area.area);
  if (point == nullptr) return false;
  const std::optional<Cone> rays = bundle_cone(world, film, area.bundle);
  return rays && are_apart(*rays, cone_of(point->frustum));
}

void warn_of_memory(const Acceleration& acceleration, const AccelerationSettings& settings,
                    std::vector<std::string>& warnings) {
  const std::uint64_t bytes = acceleration.accelerator->memory().global_bvh;
  if (settings.memory && bytes > *settings.memory)
    warnings.push_back(
        fmt::format("the BVH of the whole scene takes {}, more than the {} of 'memory' of "
                    "acceleration; it is built anyway",
                    format_bytes(bytes), format_bytes(*settings.memory)));
}

void warn_of_areas(const Acceleration& acceleration, const World& world, const FilmSettings& film,
                   std::vector<std::string>& warnings) {
  for (const auto& [area, plan, built] : acceleration.areas) {
    if (!built || !area.declared) continue;
    const LocalBvhReport& report = acceleration.local->reports()[*built];
    const std::string title = fmt::format("influence area '{}'", area.name);
    if (no_ray_enters(area, world, film))
      warnings.push_back(title + " lies where its light sends no rays");
    else if (report.triangles == 0)
      warnings.push_back(title + " meets no mesh");
    else if (report.predicted_cost > report.global_cost)
      warnings.push_back(
          fmt::format("{} is expected to cost a ray more than the BVH of the whole scene: {:.3g} "
                      "against {:.3g}",
                      title, report.predicted_cost, report.global_cost));
  }
}

}  // namespace

std::vector<std::string> warnings_of(const Acceleration& acceleration, const World& world,
                                     const Scene& settings) {
  std::vector<std::string> warnings;
  warn_of_memory(acceleration, settings.acceleration, warnings);
  warn_of_areas(acceleration, world, settings.film, warnings);
  return warnings;
}

}  // namespace pah
