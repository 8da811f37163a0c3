// The meshes section, and the geometry of area lights.
#include <algorithm>
#include <cmath>
#include <pah/scene/placement.hpp>

#include "load/scene/sections/imports.hpp"
#include "load/scene/sections/shapes.hpp"

namespace pah {
namespace {

using Kind = YamlNode::Kind;
using Transforms = std::vector<glm::dmat4x3>;

// Returns the largest absolute coordinates of a mesh.
DVec3 extent_of(const Mesh& mesh) {
  Vec3 extent(0);
  for (const Vec3& position : mesh.positions) extent = glm::max(extent, glm::abs(position));
  return extent;
}

// Adds an instance of the mesh for each copy, unless the triangles exceed the limit.
void add_instances(SceneReading& reading, const MapReader& map, const Instance& instance,
                   const Transforms& copies) {
  const Mesh& mesh = reading.scene.meshes[instance.mesh];
  const DVec3 extent = extent_of(mesh);
  for (const auto& copy : copies) {
    DVec3 reach = glm::abs(copy[3]);
    for (int i = 0; i < 3; ++i) reach += glm::abs(copy[i]) * extent[i];
    if (!glm::all(glm::lessThanEqual(reach, DVec3(any_number.max)))) {
      reading.context.errors.add(map.mark(),
                                 map.title() + " reaches farther than 1e18 m from the origin");
      return;
    }
  }
  reading.triangles += mesh.triangles.size() * copies.size();
  if (reading.triangles > reading.limits.triangles) {
    reading.context.errors.add(map.mark(), map.title() + " brings the scene to more than " +
                                               std::to_string(reading.limits.triangles) +
                                               " triangles");
    return;
  }
  for (const auto& copy : copies) {
    reading.scene.instances.push_back(instance);
    reading.scene.instances.back().world_from_object = copy;
  }
}

void read_shape_geometry(SceneReading& reading, MapReader& map, const YamlNode& node,
                         const GeometryUse& use, const Transforms& copies) {
  const std::size_t index = read_option(reading.context, node, map.name_of("shape"), shape_names());
  if (index >= shape_names().size()) {
    map.ignore_other_keys();
    return;
  }
  const std::size_t errors = reading.context.errors.size();
  const std::uint64_t room =
      reading.limits.triangles - std::min(reading.triangles, reading.limits.triangles);
  const auto shape = read_shape(reading, map, index, room);
  if (!shape || reading.context.errors.size() > errors) return;
  try {
    reading.scene.meshes.push_back(make_mesh(*shape));
  } catch (const std::invalid_argument& error) {
    map.error("shape", map.title() + ": " + error.what());
    return;
  }
  reading.scene.meshes.back().name = use.name;
  Instance instance;
  instance.mesh = static_cast<MeshId>(reading.scene.meshes.size() - 1);
  instance.material = use.material ? *use.material : unnamed_material(reading, 80);
  instance.light = use.light;
  add_instances(reading, map, instance, copies);
}

// Reads the key `replace`, which only files have.
void read_replacements(SceneReading& reading, MapReader& map, FileUse& use) {
  const YamlNode* node = map.find("replace");
  if (node == nullptr || !is_map(map.context(), node, map.name_of("replace"))) return;
  for (const YamlEntry& entry : node->entries)
    if (const auto material =
            reading.materials.find(map.context(), *entry.value, map.name_of("replace")))
      use.replacements.push_back({entry.key, *material, entry.mark});
  if (!use.materials)
    map.error("replace", "'replace' needs the file's materials: use: [materials]");
}

void read_file_options(SceneReading& reading, MapReader& map, MeshNormals& normals, FileUse& use) {
  map.option("normals", normals,
             EnumNames<MeshNormals>{{"file", MeshNormals::file},
                                    {"smooth", MeshNormals::smooth},
                                    {"flat", MeshNormals::flat}});
  const std::vector<std::string> options{"materials", "cameras", "lights"};
  const YamlNode* node = map.find("use", false, options);
  if (node != nullptr && is_list(map.context(), *node, map.name_of("use"))) {
    bool* const flags[] = {&use.materials, &use.cameras, &use.lights};
    for (const YamlRef& item : node->items) {
      const std::size_t index = read_option(map.context(), *item, map.name_of("use"), options);
      if (index < options.size()) *flags[index] = true;
    }
  }
  if (map.optional("use_camera", use.camera) && !use.cameras)
    map.error("use_camera", "'use_camera' needs the file's cameras: use: [cameras]");
  if (map.optional("light_scale", use.light_scale, not_negative) && !use.lights)
    map.error("light_scale", "'light_scale' needs the file's lights: use: [lights]");
  read_replacements(reading, map, use);
}

void read_file_geometry(SceneReading& reading, MapReader& map, const YamlNode& node,
                        const GeometryUse& use, const Transforms& copies) {
  MeshNormals normals = MeshNormals::file;
  FileUse file_use;
  read_file_options(reading, map, normals, file_use);
  if (file_use.materials && use.material)
    map.error("use", map.title() + " takes either 'material' or the materials of its file");
  if (file_use.lights && use.light != no_light)
    map.error("use", map.title() + " is a light of its own");
  const ImportedFile* file = import_file(reading, node, map.name_of("file"), normals, file_use);
  if (file == nullptr) return;
  const std::vector<LightId> lights =
      use_file(reading, *file, file_use, use.name, copies,
               map.mark_of(file_use.camera.empty() ? "use" : "use_camera"));
  const std::vector<MaterialId> materials = materials_of(reading, *file, file_use);
  for (std::size_t i = 0; i < file->parts.size(); ++i) {
    const MeshFilePart& part = file->parts[i];
    Instance instance;
    instance.mesh = part.mesh;
    instance.material = file_use.materials ? materials[i]
                        : use.material     ? *use.material
                                           : unnamed_material(reading, 80);
    instance.light = use.light != no_light ? use.light : lights[i];
    Transforms placed = copies;
    for (auto& copy : placed) copy = compose(copy, part.world_from_object);
    add_instances(reading, map, instance, placed);
  }
}

void describe_geometry(SceneReading& reading, MapReader& map) {
  for (std::size_t i = 0; i < shape_names().size(); ++i)
    map.describe_branch(shape_names()[i], [&](MapReader& branch) {
      branch.find("shape", true, {shape_names()[i]});
      (void)read_shape(reading, branch, i, 0);
    });
  map.describe_branch("file", [&](MapReader& branch) {
    branch.find("file", true);
    MeshNormals normals{};
    FileUse use;
    read_file_options(reading, branch, normals, use);
  });
}

}  // namespace

void read_geometry(SceneReading& reading, MapReader& map, const GeometryUse& use) {
  const Transforms copies = read_placement(reading, map);
  if (map.recording()) return describe_geometry(reading, map);
  const YamlNode* shape = map.find("shape");
  const YamlNode* file = map.find("file");
  if ((shape == nullptr) == (file == nullptr)) {
    reading.context.errors.add(map.mark(), map.title() + " takes either 'shape' or 'file'");
    map.ignore_other_keys();
    return;
  }
  if (shape != nullptr)
    read_shape_geometry(reading, map, *shape, use, copies);
  else
    read_file_geometry(reading, map, *file, use, copies);
}

std::optional<MaterialId> read_material_name(SceneReading& reading, MapReader& map) {
  const YamlNode* node = map.find("material");
  if (node == nullptr) return {};
  return reading.materials.find(reading.context, *node, map.name_of("material"));
}

MaterialId unnamed_material(SceneReading& reading, int percent) {
  const auto [entry, is_new] = reading.unnamed_materials.emplace(percent, MaterialId{});
  if (is_new) {
    Material material;
    material.model =
        DiffuseMaterial{.reflectance = {Vec3(static_cast<float>(percent) / 100), no_texture}};
    entry->second = static_cast<MaterialId>(reading.scene.materials.size());
    reading.scene.materials.push_back(std::move(material));
  }
  return entry->second;
}

void read_meshes(SceneReading& reading, const YamlNode* node) {
  const auto read_one = [&](const YamlNode* item, const std::string& title) {
    read_map(reading.context, item, "mesh", title, [&](MapReader& map) {
      const std::size_t first = reading.scene.instances.size();
      GeometryUse use;
      const bool named = map.optional("name", use.name);
      use.material = read_material_name(reading, map);
      read_geometry(reading, map, use);
      if (!named) return;
      const auto id = static_cast<std::uint32_t>(reading.first_instances.size());
      const bool any = reading.scene.instances.size() > first;
      reading.first_instances.push_back(any ? first : no_instance);
      reading.meshes.add(reading.context, use.name, id, map.mark_of("name"));
    });
  };
  if (node == nullptr) return read_one(nullptr, "mesh");
  if (!is_list(reading.context, *node, "meshes")) return;
  for (std::size_t i = 0; i < node->items.size(); ++i)
    read_one(node->items[i].get(), title_of(*node->items[i], "mesh", i));
}

}  // namespace pah
