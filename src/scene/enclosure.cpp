#include "scene/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <numbers>
#include <variant>

#include "geometry/solid_angle.hpp"

namespace pah {
namespace {

bool contains(const Bounds& box, const DVec3& point) {
  return glm::all(glm::lessThan(box.min, point)) && glm::all(glm::lessThan(point, box.max));
}

DVec3 position_of(const Camera& camera) {
  return std::visit([](const auto& model) { return DVec3(model.position); }, camera);
}

bool lets_light_through(const Material& material) {
  const ScalarInput& opacity = material.opacity;
  return std::holds_alternative<GlassMaterial>(material.model) || opacity.value < 1 ||
         opacity.texture != no_texture;
}

// A closed mesh with a lamp inside is a room, not a mistake.
bool holds_light(const Scene& scene, const std::vector<Bounds>& boxes, const Bounds& box) {
  const auto is_inside = [&](const Light& light) {
    if (const auto* point = std::get_if<PointLight>(&light.model))
      return contains(box, point->position);
    if (const auto* spot = std::get_if<SpotLight>(&light.model))
      return contains(box, spot->position);
    return false;
  };
  if (std::ranges::any_of(scene.lights, is_inside)) return true;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (scene.instances[i].light != no_light && contains(box, boxes[i].center())) return true;
  return false;
}

// Returns how often a closed surface winds around the point; a fraction for an open surface.
double winding_number(const Mesh& mesh, const DVec3& point) {
  double sum = 0;
  for (const UVec3& t : mesh.triangles) {
    const DVec3 a = DVec3(mesh.positions[t.x]) - point;
    const DVec3 b = DVec3(mesh.positions[t.y]) - point;
    const DVec3 c = DVec3(mesh.positions[t.z]) - point;
    sum += solid_angle(a, b, c, glm::dot(a, glm::cross(b, c)));
  }
  return sum / (4 * std::numbers::pi);
}

// Ignores gaps of less than a thousandth of the sphere of directions: they may be cracks.
bool is_closed_around(const Mesh& mesh, const DVec3& point) {
  return std::abs(winding_number(mesh, point)) > 0.999;
}

}  // namespace

std::optional<std::size_t> dark_enclosure(const Scene& scene, const std::vector<Bounds>& boxes) {
  const DVec3 eye = position_of(scene.camera);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (!contains(boxes[i], eye) || lets_light_through(scene.materials[instance.material]) ||
        holds_light(scene, boxes, boxes[i]))
      continue;
    // Affine maps preserve inside and outside, so test in object space.
    const glm::dmat4 object_from_world = glm::inverse(glm::dmat4(instance.world_from_object));
    if (is_closed_around(scene.meshes[instance.mesh], object_from_world * glm::dvec4(eye, 1)))
      return i;
  }
  return std::nullopt;
}

}  // namespace pah
