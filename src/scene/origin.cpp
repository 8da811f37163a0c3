#include "scene/origin.hpp"

#include <algorithm>
#include <variant>

namespace pah {
namespace {

double largest_of(const DVec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

// Returns the largest coordinate in the box relative to `origin`. Floats round by 2^-24 of it.
double reach(const Bounds& box, const DVec3& origin) {
  return largest_of(glm::max(glm::abs(box.min - origin), glm::abs(box.max - origin)));
}

// Returns the height of the picture at the box, in meters.
double view_at(const Camera& camera, const Bounds& box) {
  if (const auto* orthographic = std::get_if<OrthographicCamera>(&camera))
    return orthographic->height;
  const auto& perspective = std::get<PerspectiveCamera>(camera);
  const DVec3 nearest = glm::clamp(perspective.position, box.min, box.max);
  return glm::distance(perspective.position, nearest) * 2 *
         std::tan(glm::radians(perspective.fov) / 2);
}

// Returns how much precision an origin costs: the largest error of all boxes, relative to the size
// of the box or of the picture at the box, whichever is larger.
double harm_of(const DVec3& origin, const Camera& camera, std::span<const Bounds> boxes) {
  double harm = 0;
  for (const Bounds& box : boxes) {
    const double size = std::max(largest_of(box.max - box.min), view_at(camera, box));
    if (size > 0) harm = std::max(harm, reach(box, origin) / size);
  }
  return harm;
}

bool is_finite(const DVec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

DVec3 choose_origin(const Camera& camera, std::span<const Bounds> boxes) {
  Bounds scene;
  for (const Bounds& box : boxes) scene.extend(box);
  const DVec3 center = scene.center();
  if (!is_finite(center)) return DVec3(0);
  // Floats have digits to spare: a mesh of a 64th of the scene's size shows no loss.
  constexpr double harmless = 64;
  DVec3 best = center;
  double harm = harm_of(center, camera, boxes) / harmless;
  const auto consider = [&](const DVec3& origin) {
    const double its_harm = harm_of(origin, camera, boxes);
    if (!is_finite(origin) || !(its_harm < harm)) return;
    best = origin;
    harm = its_harm;
  };
  std::visit(
      [&](const auto& model) {
        consider(model.position);
        consider(model.look_at);
      },
      camera);
  return best;
}

bool loses_shape(const Bounds& box, const DVec3& origin) {
  // With fewer than 64 floats across, steps are visible.
  constexpr double spacing = 0x1p-23;
  return largest_of(box.max - box.min) < 64 * spacing * reach(box, origin);
}

}  // namespace pah
