#include <algorithm>
#include <atomic>
#include <cmath>
#include <pah/scene/world.hpp>
#include <stdexcept>

#include "base/parallel_for.hpp"
#include "scene/bounds.hpp"
#include "scene/enclosure.hpp"
#include "scene/origin.hpp"

namespace pah {
namespace {

// Faults of an instance, found in parallel. The message names the first faulty instance and the
// last of its faults in this order, so that it does not depend on the threads.
enum class Fault : std::uint8_t { none, index, position, normal, uv };

const char* text_of(Fault fault) {
  switch (fault) {
    case Fault::none:
      break;
    case Fault::index:
      return "a triangle has an index that is not a vertex of its mesh";
    case Fault::position:
      return "a position is not finite, or too large once transformed";
    case Fault::normal:
      return "a normal is zero or not finite";
    case Fault::uv:
      return "a texture coordinate is not finite";
  }
  return "";
}

[[noreturn]] void fail(const Mesh& mesh, const std::string& fault) {
  throw std::invalid_argument("mesh '" + mesh.name + "': " + fault);
}

DVec3 transform_point(const glm::dmat4x3& m, const Vec3& p) { return m * glm::dvec4(DVec3(p), 1); }

// Vertices or triangles in a task.
constexpr std::size_t grain = 4096;

// Returns the box of the transformed triangles, without unused vertices. Sets `invalid` if an index
// is out of range.
Bounds bounds_of(const Mesh& mesh, const glm::dmat4x3& world_from_object,
                 std::atomic<bool>& invalid) {
  return parallel_fold(
      mesh.triangles.size(), grain, Bounds{},
      [&](std::size_t first, std::size_t last) {
        Bounds bounds;
        for (std::size_t i = first; i < last; ++i) {
          const UVec3& t = mesh.triangles[i];
          for (const std::uint32_t vertex : {t.x, t.y, t.z}) {
            if (vertex >= mesh.positions.size()) {
              invalid.store(true, std::memory_order_relaxed);
              return bounds;
            }
            const DVec3 p = transform_point(world_from_object, mesh.positions[vertex]);
            bounds.extend({p, p});
          }
        }
        return bounds;
      },
      [](Bounds& a, const Bounds& b) { a.extend(b); });
}

// Returns the linear part divided by the power of 2 that bounds it. No direction changes, and
// products of three entries cannot overflow.
DMat3 normalized_linear(const glm::dmat4x3& m) {
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
  int exponent = 0;
  std::frexp(largest, &exponent);
  DMat3 linear(m);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      linear[column][row] = std::ldexp(linear[column][row], -exponent);
  return linear;
}

void require_valid(const Scene& scene, const Instance& instance) {
  if (instance.mesh >= scene.meshes.size())
    throw std::invalid_argument("an instance refers to a mesh that does not exist");
  const Mesh& mesh = scene.meshes[instance.mesh];
  if (instance.material >= scene.materials.size())
    fail(mesh, "its instance refers to a material that does not exist");
  if (instance.light != no_light && instance.light >= scene.lights.size())
    fail(mesh, "its instance refers to a light that does not exist");
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
    fail(mesh, "there must be as many normals as positions, or none");
  if (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size())
    fail(mesh, "there must be as many texture coordinates as positions, or none");
  if (!mesh.colors.empty() && mesh.colors.size() != mesh.positions.size())
    fail(mesh, "there must be as many colors as positions, or none");
  const double det = glm::determinant(normalized_linear(instance.world_from_object));
  if (!std::isfinite(det) || det == 0) fail(mesh, "its transform is not finite or flattens it");
}

// The position of an instance's data in the arrays of the World.
struct Slot {
  std::uint32_t first_position = 0;
  std::uint32_t first_triangle = 0;
};

Fault copy_vertices(const Mesh& mesh, const glm::dmat4x3& world_from_object, const Slot& slot,
                    World& world) {
  const DMat3 linear = normalized_linear(world_from_object);
  // Normals transform by the inverse transpose: the matrix of cofactors over the determinant. Only
  // the determinant's sign matters.
  const double sign = std::copysign(1.0, glm::determinant(linear));
  const DMat3 normal_matrix{sign * glm::cross(linear[1], linear[2]),
                            sign * glm::cross(linear[2], linear[0]),
                            sign * glm::cross(linear[0], linear[1])};
  const auto copy = [&](std::size_t begin, std::size_t end) {
    Fault fault = Fault::none;
    const auto note = [&](Fault found) { fault = std::max(fault, found); };
    for (std::size_t i = begin; i != end; ++i) {
      const std::size_t out = slot.first_position + i;
      const Vec3 p{transform_point(world_from_object, mesh.positions[i]) - world.origin};
      if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))) note(Fault::position);
      world.positions[out] = p;
      if (!mesh.normals.empty()) {
        const DVec3 n = normal_matrix * DVec3(mesh.normals[i]);
        const double length = glm::length(n);
        if (!(length > 0 && std::isfinite(length))) note(Fault::normal);
        world.normals[out] = Vec3(n / length);
      }
      if (!mesh.uvs.empty()) {
        const Vec2& uv = mesh.uvs[i];
        if (!(std::isfinite(uv.x) && std::isfinite(uv.y))) note(Fault::uv);
        world.uvs[out] = uv;
      }
      if (!mesh.colors.empty()) world.colors[out] = mesh.colors[i];
    }
    return fault;
  };
  return parallel_fold(mesh.positions.size(), grain, Fault::none, copy,
                       [](Fault& a, Fault b) { a = std::max(a, b); });
}

void copy_triangles(const Mesh& mesh, bool mirrored, const Slot& slot, std::uint32_t surface,
                    World& world) {
  parallel_ranges(mesh.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      const UVec3 t = mesh.triangles[i] + slot.first_position;
      world.indices[slot.first_triangle + i] = mirrored ? UVec3{t.x, t.z, t.y} : t;
      world.surface_of_triangle[slot.first_triangle + i] = surface;
    }
  });
}

// Resizes the arrays of the World, and assigns each instance its slot in them.
std::vector<Slot> lay_out(const Scene& scene, World& world) {
  constexpr std::uint64_t limit = 0xFFFFFFFEULL;
  std::uint64_t positions = 0;
  std::uint64_t triangles = 0;
  bool any_normals = false;
  bool any_uvs = false;
  bool any_colors = false;
  std::vector<Slot> slots;
  slots.reserve(scene.instances.size());
  world.surfaces.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    require_valid(scene, instance);
    const Mesh& mesh = scene.meshes[instance.mesh];
    slots.push_back({static_cast<std::uint32_t>(positions), static_cast<std::uint32_t>(triangles)});
    world.surfaces.push_back({instance.material, instance.light,
                              static_cast<std::uint32_t>(triangles),
                              static_cast<std::uint32_t>(mesh.triangles.size()),
                              !mesh.normals.empty(), !mesh.uvs.empty(), !mesh.colors.empty()});
    positions += mesh.positions.size();
    triangles += mesh.triangles.size();
    any_normals |= !mesh.normals.empty();
    any_uvs |= !mesh.uvs.empty();
    any_colors |= !mesh.colors.empty();
    if (positions > limit || triangles > limit)
      throw std::length_error("the scene has more than 2^32 - 2 triangles or vertices");
  }
  world.positions.resize(positions);
  if (any_normals) world.normals.resize(positions);
  if (any_uvs) world.uvs.resize(positions);
  if (any_colors) world.colors.resize(positions);
  world.indices.resize(triangles);
  world.surface_of_triangle.resize(triangles);
  return slots;
}

void throw_first(const Scene& scene, const std::vector<Fault>& faults) {
  for (std::size_t i = 0; i < faults.size(); ++i)
    if (faults[i] != Fault::none) fail(scene.meshes[scene.instances[i].mesh], text_of(faults[i]));
}

// Returns the bounding boxes of all instances.
std::vector<Bounds> boxes_of(const Scene& scene) {
  std::vector<Bounds> boxes(scene.instances.size());
  std::vector<Fault> faults(scene.instances.size(), Fault::none);
  parallel_for(scene.instances.size(), 1, [&](std::size_t i) {
    const Instance& instance = scene.instances[i];
    std::atomic<bool> invalid{false};
    boxes[i] = bounds_of(scene.meshes[instance.mesh], instance.world_from_object, invalid);
    if (invalid) faults[i] = Fault::index;
  });
  throw_first(scene, faults);
  return boxes;
}

std::string title_of(const std::string& mesh) {
  return mesh.empty() ? "a mesh" : "mesh '" + mesh + "'";
}

void warn_of_lost_shapes(const Scene& scene, const std::vector<Bounds>& boxes, World& world) {
  std::size_t lost = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!loses_shape(boxes[i], world.origin)) continue;
    if (lost++ == 0) first = i;
  }
  if (lost == 0) return;
  const std::string& name = scene.meshes[scene.instances[first].mesh].name;
  world.warnings.push_back(
      title_of(name) + (lost > 1 ? " and " + std::to_string(lost - 1) + " more are" : " is") +
      " too far from the rest of the scene for its size: rounding destroys its shape");
}

void warn_of_dark_camera(const Scene& scene, const std::vector<Bounds>& boxes, World& world) {
  if (const auto instance = dark_enclosure(scene, boxes))
    world.warnings.push_back("the camera is inside " +
                             title_of(scene.meshes[scene.instances[*instance].mesh].name) +
                             ", which is closed: no light gets in");
}

void recenter(World& world) {
  std::visit(
      [&](auto& camera) {
        camera.position -= world.origin;
        camera.look_at -= world.origin;
      },
      world.camera);
  for (Light& light : world.lights) {
    if (auto* point = std::get_if<PointLight>(&light.model)) point->position -= world.origin;
    if (auto* spot = std::get_if<SpotLight>(&light.model)) spot->position -= world.origin;
  }
}

template <class T>
std::uint64_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

World make_world(const Scene& scene) {
  World world;
  world.camera = scene.camera;
  world.lights = scene.lights;
  world.materials = scene.materials;
  world.textures = scene.textures;
  const std::vector<Slot> slots = lay_out(scene, world);
  const std::vector<Bounds> boxes = boxes_of(scene);
  world.origin = choose_origin(scene.camera, boxes);
  warn_of_lost_shapes(scene, boxes, world);
  warn_of_dark_camera(scene, boxes, world);
  recenter(world);

  std::vector<Fault> faults(scene.instances.size(), Fault::none);
  parallel_for(scene.instances.size(), 1, [&](std::size_t i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool mirrored = glm::determinant(normalized_linear(instance.world_from_object)) < 0;
    faults[i] = copy_vertices(mesh, instance.world_from_object, slots[i], world);
    copy_triangles(mesh, mirrored, slots[i], static_cast<std::uint32_t>(i), world);
  });
  throw_first(scene, faults);
  world.bounds = bounds_of(world.triangles());
  return world;
}

std::uint64_t World::bytes() const {
  return bytes_of(positions) + bytes_of(normals) + bytes_of(uvs) + bytes_of(colors) +
         bytes_of(indices) + bytes_of(surface_of_triangle) + bytes_of(surfaces) + bytes_of(lights) +
         bytes_of(materials) + bytes_of(textures);
}

}  // namespace pah
