// Reads the sections of a scene file into a Scene.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <pah/load/load_scene.hpp>
#include <pah/load/mesh_file.hpp>
#include <pah/scene/scene.hpp>
#include <string>
#include <unordered_map>

#include "load/scene/files/files.hpp"
#include "load/yaml/reader.hpp"

namespace pah {

// Ids by name, for one kind of object.
class NameTable {
 public:
  explicit NameTable(std::string kind) : kind_(std::move(kind)) {}

  // Reports an error at `mark` and returns false if the name exists.
  bool add(ReadContext& context, const std::string& name, std::uint32_t id, const Mark& mark);
  // Does nothing if the name exists.
  void add_unless_known(const std::string& name, std::uint32_t id);
  // Returns the id of the name, or reports that it is unknown.
  std::optional<std::uint32_t> find(ReadContext& context, const YamlNode& node,
                                    const ValueName& name) const;

 private:
  struct Entry {
    std::uint32_t id;
    Mark mark;
  };
  std::string kind_;
  std::unordered_map<std::string, Entry> entries_;
  std::vector<std::string> names_;  // in order, for suggestions
};

inline constexpr std::size_t no_instance = ~std::size_t{0};

// A mesh file whose meshes, materials and textures are in the scene.
struct ImportedFile {
  std::vector<MeshFilePart> parts;  // ids are the scene's
  std::vector<AreaLight> emission;  // one per part
  std::vector<NamedCamera> cameras;
  std::vector<Light> lights;
};

// The place that first names a picture, and its bytes if it is embedded in another file.
struct NamedPicture {
  Mark mark;
  std::shared_ptr<const std::string> bytes{};
};

struct SceneReading {
  ReadContext& context;
  Scene& scene;
  SceneFiles& files;
  const LoadLimits& limits;
  NameTable textures{"texture"};
  NameTable materials{"material"};
  NameTable meshes{"mesh"};
  NameTable lights{"light"};
  std::unordered_map<std::string, TextureId> images{};  // inline images, by path and color space
  std::unordered_map<TextureId, TextureId> linear_copies{};  // of images used as numbers
  std::map<std::filesystem::path, NamedPicture> pictures{};  // of textures
  std::vector<std::size_t> first_instances{};  // by id in `meshes`; no_instance without an instance
  std::unordered_map<std::string, ImportedFile> imported{};  // mesh files, by path and options
  std::unordered_map<int, MaterialId> unnamed_materials{};   // by reflectance in percent
  std::uint64_t triangles = 0;                               // of all instances so far
  const YamlNode* camera = nullptr;                          // the camera section
  bool has_imported_camera = false;                          // from a mesh file
};

// Returns "mesh 'floor'", or "mesh 3" (from 1) for a mesh without a name.
[[nodiscard]] std::string title_of(const YamlNode& node, const std::string& kind,
                                   std::size_t index);

void read_camera(SceneReading& reading, const YamlNode* node);
// Makes a mesh file's camera the scene's, adjusted by the camera section, which must not place a
// camera itself. `mark` is the place that selects the file's camera.
void adopt_camera(SceneReading& reading, const Camera& camera, const Mark& mark);
void read_film(SceneReading& reading, const YamlNode* node);
void read_render(SceneReading& reading, const YamlNode* node);
void read_textures(SceneReading& reading, const YamlNode* node);
void read_materials(SceneReading& reading, const YamlNode* node);
void read_meshes(SceneReading& reading, const YamlNode* node);
void read_lights(SceneReading& reading, const YamlNode* node);
void read_influence_areas(SceneReading& reading, const YamlNode* node);
void read_acceleration(SceneReading& reading, const YamlNode* node);

// Reads a linear color: [r, g, b], one number for all three, or "#rrggbb" in sRGB.
bool read_color(ReadContext& context, const YamlNode& node, const ValueName& name, Vec3& value,
                const NumberRange& range = not_negative);
// Reads a value, or a scaled {texture: name} or {image: file}. `range` limits value and scale.
void read_input(SceneReading& reading, MapReader& map, std::string_view key, ColorInput& input,
                const NumberRange& range);
void read_input(SceneReading& reading, MapReader& map, std::string_view key, ScalarInput& input,
                const NumberRange& range);
// Reads {texture: name} or {image: file} as numbers, not as colors.
void read_normal_map(SceneReading& reading, MapReader& map, std::string_view key,
                     TextureId& texture);
// Returns the texture of an image file that is named without a texture.
std::optional<TextureId> image_texture(SceneReading& reading, const YamlNode& node,
                                       const ValueName& name, ColorSpace color_space);

// Reads one step or a list of steps, which apply in order.
[[nodiscard]] DMat4 read_transform(ReadContext& context, const YamlNode* node,
                                   const std::string& title);
// Reads {axis, angle}, or an angle about y.
[[nodiscard]] DMat3 read_rotation(ReadContext& context, const YamlNode* node,
                                  const ValueName& name);
// Reads the keys transform, repeat and scatter: the placement of all copies.
[[nodiscard]] std::vector<glm::dmat4x3> read_placement(SceneReading& reading, MapReader& map);

// The name, material and light of a mesh's or area light's geometry.
struct GeometryUse {
  std::string name;
  std::optional<MaterialId> material;
  LightId light = no_light;
};
// Reads the key `shape` or `file` with its options and the placement, and adds meshes and instances
// to the scene.
void read_geometry(SceneReading& reading, MapReader& map, const GeometryUse& use);

// Returns the material that the key `material` names.
[[nodiscard]] std::optional<MaterialId> read_material_name(SceneReading& reading, MapReader& map);
// Returns a gray diffuse material without a name, which is made when first needed.
[[nodiscard]] MaterialId unnamed_material(SceneReading& reading, int percent);

// Reports pictures that cannot be read or are too large, and warns of values that are not finite.
void check_pictures(SceneReading& reading);

}  // namespace pah
