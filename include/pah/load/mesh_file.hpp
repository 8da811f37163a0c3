// Reads mesh files: OBJ, PLY, STL and glTF 2.0 (.gltf, .glb).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <pah/base/errors.hpp>
#include <pah/scene/scene.hpp>
#include <string>
#include <vector>

namespace pah {

enum class MeshNormals {
  file,    // those of the file; flat where it has none
  smooth,  // computed from the triangles around each vertex, weighted by angle
  flat     // none
};

struct MeshFileOptions {
  MeshNormals normals = MeshNormals::file;
  std::uint64_t file_bytes = 4ULL << 30;  // of the file and of each buffer that it names
  std::uint64_t triangles = 100'000'000;  // and three times as many vertices
  // Files that the mesh file names (buffers, images, .mtl) must lie in or under this folder; empty
  // for the mesh file's own. Links may lead out of it.
  std::filesystem::path folder;
  // Everything as one mesh, the transforms of nodes applied, without materials, cameras and lights.
  bool merged = false;
  // Called with each further file of geometry or materials before it is read, also if it does not
  // exist. Images are not read, only named.
  std::function<void(const std::filesystem::path&)> on_file = {};
};

// An error in a mesh file. Line and column of an OBJ or ASCII PLY or STL file count from 1;
// 0 means not known. The message does not repeat the file's name.
class MeshFileError : public std::runtime_error {
 public:
  explicit MeshFileError(const std::string& message, int line = 0, int column = 0,
                         std::string excerpt = {})
      : std::runtime_error(message), line_(line), column_(column), excerpt_(std::move(excerpt)) {}
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] int column() const { return column_; }
  [[nodiscard]] const std::string& excerpt() const { return excerpt_; }  // the line, or empty

 private:
  int line_;
  int column_;
  std::string excerpt_;
};

// A mesh of the file at a place: an index in MeshFile::meshes and one in MeshFile::materials.
struct MeshFilePart {
  MeshId mesh = 0;
  MaterialId material = 0;
  glm::dmat4x3 world_from_object{1.0};
};

struct NamedCamera {
  std::string name;
  Camera camera;
};

// A mesh file as a small scene; every id is an index in the vectors of this struct.
struct MeshFile {
  std::vector<Mesh> meshes;  // one material each; used by at least one part
  std::vector<MeshFilePart> parts;
  std::vector<Material> materials;  // never empty
  std::vector<Texture> textures;
  std::vector<NamedCamera> cameras;
  // Point, spot and directional lights of glTF, whose units are photometric: 683 lm/W turn them
  // into watts. Area lights of emissive materials are not among them.
  std::vector<Light> lights;
  std::vector<AreaLight> emission;    // per material: how it shines; black if it does not
  std::vector<std::string> warnings;  // what was left out, one sentence each
};

// Extensions that can be read, with dots, lower case.
[[nodiscard]] const std::vector<std::string>& mesh_extensions();

// Reads a file with its materials, textures, cameras and lights, unless `options.merged`. Throws
// MeshFileError.
[[nodiscard]] MeshFile read_mesh_file(const std::filesystem::path& file,
                                      const MeshFileOptions& options = {});

// Reads everything in the file as one mesh. Throws MeshFileError.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file, MeshFileOptions options = {});

}  // namespace pah
