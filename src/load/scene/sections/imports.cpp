#include "load/scene/sections/imports.hpp"

#include <algorithm>
#include <type_traits>

#include "base/extension.hpp"
#include "load/mesh/common/folder.hpp"
#include "load/yaml/suggest.hpp"

namespace pah {
namespace {

// Calls visit(ColorInput&) and visit(ScalarInput&) for every input of a material.
template <class Visit>
void for_each_input(Material& material, Visit&& visit) {
  visit(material.opacity);
  std::visit(
      [&](auto& model) {
        using Model = std::decay_t<decltype(model)>;
        if constexpr (requires { model.reflectance; }) visit(model.reflectance);
        if constexpr (requires { model.roughness; }) visit(model.roughness);
        if constexpr (std::is_same_v<Model, GlassMaterial>) visit(model.transmittance);
        if constexpr (std::is_same_v<Model, MetalMaterial>) visit(model.tint);
        if constexpr (std::is_same_v<Model, PrincipledMaterial>) {
          visit(model.base_color);
          visit(model.metallic);
        }
      },
      material.model);
}

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// Hashes what a mesh file takes from the files that it names.
std::string content_hash(const std::filesystem::path& path, MeshFile& file) {
  ContentHash hash;
  const std::string extension = lower_extension(path);
  // Other formats hold their geometry themselves.
  const bool names_geometry = extension == ".gltf" || extension == ".glb";
  for (const Mesh& mesh : file.meshes) {
    if (!names_geometry) break;
    hash.add_part(bytes_of(mesh.positions));
    hash.add_part(bytes_of(mesh.normals));
    hash.add_part(bytes_of(mesh.uvs));
    if (!mesh.colors.empty()) hash.add_part(bytes_of(mesh.colors));
    hash.add_part(bytes_of(mesh.triangles));
  }
  for (Material& material : file.materials)
    for_each_input(material, [&](const auto& input) {
      hash.add({reinterpret_cast<const char*>(&input.value), sizeof input.value});
    });
  return hash.hex();
}

// Takes the file from the last load if none of its files has changed.
ReadMeshFile read_or_take(SceneReading& reading, const std::filesystem::path& path,
                          const std::string& key, MeshFileOptions options) {
  LoadedFiles::Impl* const loaded = reading.files.loaded();
  if (loaded != nullptr)
    if (const auto* kept = loaded->meshes.find(key)) {
      for (const auto& [file, stamp] : kept->files) reading.files.announce(file);
      return kept->value;
    }
  StampedFiles files{{path, stamp_of(path)}};
  options.on_file = [&](const std::filesystem::path& file) {
    files.emplace_back(file, stamp_of(file));
    reading.files.announce(file);
  };
  ReadMeshFile read{read_mesh_file(path, options), ""};
  read.content_hash = content_hash(path, read.file);
  if (loaded != nullptr) loaded->meshes.put(key, std::move(files), read);
  return read;
}

// Adds the file's content to the scene, and converts its ids to the scene's.
ImportedFile add_file(SceneReading& reading, MeshFile file, const Mark& mark) {
  Scene& scene = reading.scene;
  const auto first_mesh = static_cast<MeshId>(scene.meshes.size());
  const auto first_material = static_cast<MaterialId>(scene.materials.size());
  const auto first_texture = static_cast<TextureId>(scene.textures.size());
  for (Texture& texture : file.textures) {
    if (const auto* image = std::get_if<ImageTexture>(&texture)) {
      // An embedded picture was opened with its file.
      const bool is_open =
          image->bytes != nullptr ||
          reading.files.open(reading.context, mark, image->file, reading.limits.image_bytes);
      if (image->bytes != nullptr) reading.files.hash().add_part(*image->bytes);
      if (is_open) reading.pictures.emplace(image->file, NamedPicture{mark, image->bytes});
    }
    scene.textures.push_back(std::move(texture));
  }
  const auto shift = [&](TextureId& id) {
    if (id != no_texture) id += first_texture;
  };
  for (Material& material : file.materials) {
    shift(material.normal_map);
    for_each_input(material, [&](auto& input) { shift(input.texture); });
    scene.materials.push_back(std::move(material));
  }
  for (AreaLight& emission : file.emission) shift(emission.image);
  for (Mesh& mesh : file.meshes) scene.meshes.push_back(std::move(mesh));

  ImportedFile imported;
  for (MeshFilePart part : file.parts) {
    imported.emission.push_back(part.material < file.emission.size()
                                    ? file.emission[part.material]
                                    : AreaLight{.radiance = Vec3(0)});
    part.mesh += first_mesh;
    part.material += first_material;
    imported.parts.push_back(part);
  }
  imported.cameras = std::move(file.cameras);
  imported.lights = std::move(file.lights);
  return imported;
}

std::string located_message(const std::string& file, const MeshFileError& error) {
  std::string text = "mesh file '" + file + "'";
  if (error.line() > 0) text += ", line " + std::to_string(error.line());
  if (error.line() > 0 && error.column() > 0) text += ", column " + std::to_string(error.column());
  return text + ": " + error.what();
}

DVec3 move_point(const glm::dmat4x3& m, const DVec3& point) { return m * glm::dvec4(point, 1); }
DVec3 move_direction(const glm::dmat4x3& m, const DVec3& direction) {
  return m * glm::dvec4(direction, 0);
}

Light moved(Light light, const glm::dmat4x3& m) {
  std::visit(
      [&](auto& model) {
        if constexpr (requires { model.position; }) model.position = move_point(m, model.position);
        if constexpr (requires { model.direction; })
          model.direction = move_direction(m, model.direction);
      },
      light.model);
  return light;
}

Light scaled(Light light, double factor) {
  std::visit(
      [&](auto& model) {
        const auto scale = static_cast<float>(factor);
        if constexpr (requires { model.intensity; }) model.intensity *= scale;
        if constexpr (requires { model.irradiance; }) model.irradiance *= scale;
      },
      light.model);
  return light;
}

// Returns the camera called `name`, or the first camera if `name` is empty.
const NamedCamera* chosen_camera(SceneReading& reading, const ImportedFile& file,
                                 const std::string& name, const Mark& mark) {
  std::vector<std::string> names;
  for (const NamedCamera& camera : file.cameras) {
    if (name.empty() || camera.name == name) return &camera;
    names.push_back(camera.name);
  }
  reading.context.errors.add(mark, names.empty() ? "the mesh file has no camera"
                                                 : "the mesh file has no camera '" + name + "'" +
                                                       suggestion_and_options(name, names));
  return nullptr;
}

Camera moved(Camera camera, const glm::dmat4x3& m) {
  std::visit(
      [&](auto& model) {
        model.position = move_point(m, model.position);
        model.look_at = move_point(m, model.look_at);
        model.up = move_direction(m, model.up);
      },
      camera);
  return camera;
}

}  // namespace

const ImportedFile* import_file(SceneReading& reading, const YamlNode& node, const ValueName& name,
                                MeshNormals normals, const FileUse& use) {
  const auto path = reading.files.open(reading.context, node, name, reading.limits.mesh_file_bytes);
  if (!path) return nullptr;
  const bool whole = use.materials || use.cameras || use.lights;
  const std::string key =
      std::to_string(static_cast<int>(normals)) + (whole ? "w" : "m") + path->string();
  const auto found = reading.imported.find(key);
  if (found != reading.imported.end()) return &found->second;

  MeshFileOptions options;
  options.normals = normals;
  options.merged = !whole;
  options.file_bytes = reading.limits.mesh_file_bytes;
  options.triangles =
      reading.limits.triangles - std::min(reading.triangles, reading.limits.triangles);
  // A mesh file in the scene's folder may name files anywhere in that folder.
  if (lies_in(*path, reading.files.folder())) options.folder = reading.files.folder();
  try {
    ReadMeshFile read = read_or_take(reading, *path, key, options);
    reading.files.hash().add_part(read.content_hash);
    for (const std::string& warning : read.file.warnings)
      reading.context.errors.warn(node.mark, "mesh file '" + node.text + "': " + warning);
    return &reading.imported.emplace(key, add_file(reading, std::move(read.file), node.mark))
                .first->second;
  } catch (const MeshFileError& error) {
    reading.context.errors.add(node.mark, located_message(node.text, error));
    return nullptr;
  }
}

std::vector<MaterialId> materials_of(SceneReading& reading, const ImportedFile& file,
                                     const FileUse& use) {
  std::vector<MaterialId> materials;
  std::vector<std::string> names;
  for (const MeshFilePart& part : file.parts) {
    materials.push_back(part.material);
    names.push_back(use.materials ? reading.scene.materials[part.material].name : "");
  }
  for (const FileUse::Replacement& replacement : use.replacements) {
    bool found = false;
    for (std::size_t i = 0; i < materials.size(); ++i) {
      if (names[i] != replacement.name) continue;
      materials[i] = replacement.by;
      found = true;
    }
    if (found) continue;
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    reading.context.errors.add(replacement.mark,
                               "the mesh file uses no material '" + replacement.name + "'" +
                                   suggestion_and_options(replacement.name, names));
    break;
  }
  return materials;
}

std::vector<LightId> use_file(SceneReading& reading, const ImportedFile& file, const FileUse& use,
                              const std::string& mesh_name, const std::vector<glm::dmat4x3>& copies,
                              const Mark& mark) {
  Scene& scene = reading.scene;
  const auto add_light = [&](Light light, const std::string& name) {
    const auto id = static_cast<LightId>(scene.lights.size());
    light.name = mesh_name + "." + name;
    reading.lights.add_unless_known(light.name, id);
    scene.lights.push_back(std::move(light));
    return id;
  };
  if (use.cameras) {
    if (reading.has_imported_camera)
      reading.context.errors.add(mark, "the scene has a camera of a mesh file already");
    else if (const NamedCamera* camera = chosen_camera(reading, file, use.camera, mark))
      adopt_camera(reading, moved(camera->camera, copies.front()), mark);
    reading.has_imported_camera = true;
  }
  std::vector<LightId> lights(file.parts.size(), no_light);
  if (!use.lights) return lights;
  for (const auto& copy : copies)
    for (const Light& light : file.lights)
      add_light(scaled(moved(light, copy), use.light_scale), light.name);
  std::unordered_map<MaterialId, LightId> emitters;
  for (std::size_t i = 0; i < file.parts.size(); ++i) {
    if (file.emission[i].radiance == Vec3(0)) continue;
    const MaterialId material = file.parts[i].material;
    const auto [entry, is_new] = emitters.emplace(material, no_light);
    if (is_new) {
      AreaLight emission = file.emission[i];
      emission.radiance *= static_cast<float>(use.light_scale);
      entry->second = add_light({"", emission}, scene.materials[material].name);
    }
    lights[i] = entry->second;
  }
  return lights;
}

}  // namespace pah
