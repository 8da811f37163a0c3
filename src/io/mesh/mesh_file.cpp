#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <memory>
#include <pah/io/mesh_file.hpp>
#include <pah/scene/placement.hpp>
#include <sstream>

#include "geometry/normal.hpp"
#include "io/extension.hpp"
#include "io/mesh/access.hpp"
#include "io/mesh/gltf.hpp"
#include "io/mesh/materials.hpp"
#include "io/mesh/polygon.hpp"
#include "io/mesh/scan.hpp"
#include "io/mesh/weld.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

constexpr unsigned max_polygon_corners = 10'000;  // triangulation takes their square, or more

// Leaves the importer of one format, whatever the file looks like inside.
void keep_importer(Assimp::Importer& importer, const std::string& extension) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const aiImporterDesc* const info = importer.GetImporterInfo(i);
    bool keeps = false;
    std::istringstream words(info->mFileExtensions);
    for (std::string word; words >> word;) keeps |= "." + word == extension;
    // glTF 1.0 goes by the same extensions.
    keeps = keeps && std::string(info->mName) != "glTF Importer";
    if (keeps) continue;
    // An importer that is unregistered is no longer owned by anyone.
    const std::unique_ptr<Assimp::BaseImporter> unwanted(importer.GetImporter(i));
    importer.UnregisterLoader(unwanted.get());
  }
}

// What assimp read, checked: every index is in range, and only triangles count.
class ImportedScene {
 public:
  // `strict`: a file that may not be opened is an error, not just not there.
  ImportedScene(const fs::path& file, const MeshFileOptions& options, bool strict);

  [[nodiscard]] const aiScene& operator*() const { return *scene_; }
  [[nodiscard]] const aiScene* operator->() const { return scene_; }
  // Empty for other formats.
  [[nodiscard]] const GltfDocument& gltf() const { return gltf_; }

 private:
  void check(const MeshFileOptions& options) const;

  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
  GltfDocument gltf_;
};

ImportedScene::ImportedScene(const fs::path& file, const MeshFileOptions& options, bool strict) {
  std::error_code error;
  const std::string extension = lower_extension(file);
  const auto& known = mesh_extensions();
  if (std::find(known.begin(), known.end(), extension) == known.end()) {
    std::string available;
    for (const std::string& name : known) available += (available.empty() ? "" : ", ") + name;
    throw MeshFileError("unknown mesh format '" + extension + "'; available are " + available);
  }
  if (!fs::is_regular_file(file, error)) throw MeshFileError("it does not exist, or is not a file");
  if (fs::file_size(file, error) > options.file_bytes)
    throw MeshFileError("the file is larger than " + std::to_string(options.file_bytes >> 20) +
                        " MB");
  const fs::path folder = folder_of(file, options.folder);
  if (extension == ".obj") scan_obj(file, options.triangles);
  if (extension == ".ply") scan_ply(file);
  if (extension == ".gltf" || extension == ".glb")
    gltf_ = read_gltf_document(file, folder, options.file_bytes);

  auto* const files = new LimitedFiles(file, folder, options.file_bytes);
  if (!gltf_.cleaned.empty()) files->replace_main(gltf_.cleaned);
  importer_.SetIOHandler(files);  // which owns it
  keep_importer(importer_, extension);
  scene_ = importer_.ReadFile(file.string(), 0);
  if (strict && !files->refusal().empty()) throw MeshFileError(files->refusal());
  if (scene_ == nullptr) throw MeshFileError(importer_.GetErrorString());
  check(options);
}

void ImportedScene::check(const MeshFileOptions& options) const {
  std::uint64_t triangles = 0;
  for (unsigned m = 0; m < scene_->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene_->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices > max_polygon_corners)
        throw MeshFileError("a face of more than " + std::to_string(max_polygon_corners) +
                            " corners");
      for (unsigned k = 0; k < face.mNumIndices; ++k)
        if (face.mIndices[k] >= mesh.mNumVertices)
          throw MeshFileError("face " + std::to_string(f) + " uses vertex " +
                              std::to_string(face.mIndices[k]) + " of " +
                              std::to_string(mesh.mNumVertices));
      if (face.mNumIndices > 2) triangles += face.mNumIndices - 2;
    }
    if (mesh.mMaterialIndex >= scene_->mNumMaterials)
      throw MeshFileError("a mesh uses no material of the file");
  }
  if (triangles > options.triangles)
    throw MeshFileError("more than " + std::to_string(options.triangles) + " triangles");
}

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Vec3 vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

bool has_uvs(const aiMesh& mesh) {
  return mesh.HasTextureCoords(0) && mesh.mNumUVComponents[0] >= 2;
}

// An aiMesh's triangles, transformed, into a builder.
class MeshReader {
 public:
  MeshReader(const aiMesh& mesh, const glm::dmat4x3& world_from_object)
      : mesh_(mesh), world_from_object_(world_from_object) {
    const DMat3 m(world_from_object);
    const double det = glm::determinant(m);
    mirrored_ = det < 0;
    const double sign = mirrored_ ? -1 : 1;
    normal_matrix_ = DMat3(sign * glm::cross(m[1], m[2]), sign * glm::cross(m[2], m[0]),
                           sign * glm::cross(m[0], m[1]));
    moves_ = world_from_object != glm::dmat4x3{1.0};
  }

  // `normals`: whether to hand the file's normals, or flat ones where there are none, to `out`.
  void read(bool normals, MeshBuilder& out, std::uint64_t max_triangles) {
    for (unsigned f = 0; f < mesh_.mNumFaces; ++f) {
      const aiFace& face = mesh_.mFaces[f];
      if (face.mNumIndices < 3) continue;  // a point or a line
      corners_.clear();
      for (unsigned k = 0; k < face.mNumIndices; ++k)
        corners_.push_back(position(face.mIndices[k]));
      triangulate(corners_, triangles_);
      if (out.triangles() + triangles_.size() > max_triangles)
        throw MeshFileError("more than " + std::to_string(max_triangles) + " triangles");
      for (const UVec3& t : triangles_) add(face, t, normals, out);
    }
  }

 private:
  void add(const aiFace& face, UVec3 t, bool normals, MeshBuilder& out) const {
    if (mirrored_) std::swap(t.y, t.z);
    const Vec3 positions[3] = {corners_[t.x], corners_[t.y], corners_[t.z]};
    UVec3 triangle;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = face.mIndices[t[k]];
      triangle[k] =
          out.add_vertex(positions[k], normals ? normal(vertex, positions) : Vec3(0), uv(vertex));
    }
    out.add_triangle(triangle);
  }

  [[nodiscard]] Vec3 position(std::uint32_t vertex) const {
    Vec3 p = vec(mesh_.mVertices[vertex]);
    if (moves_) p = Vec3(world_from_object_ * glm::dvec4(DVec3(p), 1));
    if (!finite(p)) fail_at(vertex, "position");
    return p;
  }

  [[nodiscard]] Vec3 normal(std::uint32_t vertex, const Vec3 (&positions)[3]) const {
    if (mesh_.HasNormals()) {
      const Vec3 given = vec(mesh_.mNormals[vertex]);
      const DVec3 n = moves_ ? normal_matrix_ * DVec3(given) : DVec3(given);
      const double length = glm::length(n);
      if (length > 0 && std::isfinite(length)) return Vec3(n / length);
    }
    // Files have normals of no length where triangles have no area, too.
    const DVec3 flat = scaled_normal({positions[0], positions[1], positions[2]});
    const double length = glm::length(flat);
    return length > 0 ? Vec3(flat / length) : Vec3(0, 1, 0);
  }

  [[nodiscard]] Vec2 uv(std::uint32_t vertex) const {
    if (!has_uvs(mesh_)) return Vec2(0);
    const aiVector3D& t = mesh_.mTextureCoords[0][vertex];
    if (!std::isfinite(t.x) || !std::isfinite(t.y)) fail_at(vertex, "texture coordinate");
    return {t.x, t.y};
  }

  [[noreturn]] void fail_at(std::uint32_t vertex, const char* what) const {
    throw MeshFileError("the " + std::string(what) + " of vertex " + std::to_string(vertex) +
                        " is not finite");
  }

  const aiMesh& mesh_;
  glm::dmat4x3 world_from_object_;
  DMat3 normal_matrix_{1.0};
  bool mirrored_ = false;
  std::vector<Vec3> corners_;     // of the face at hand
  std::vector<UVec3> triangles_;  // of their numbers
  bool moves_ = false;
};

// An aiMesh where a node puts it.
struct Placed {
  unsigned mesh;
  glm::dmat4x3 world_from_object;
};

// The tree has been checked to be one (glTF), or is flat.
void collect(const aiNode& node, const glm::dmat4x3& world_from_parent,
             std::vector<Placed>& placed) {
  const glm::dmat4x3 world_from_node = compose(world_from_parent, matrix_of(node.mTransformation));
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    placed.push_back({node.mMeshes[i], world_from_node});
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    collect(*node.mChildren[i], world_from_node, placed);
}

std::vector<Placed> placed_meshes(const aiScene& scene) {
  std::vector<Placed> placed;
  if (scene.mRootNode != nullptr) collect(*scene.mRootNode, glm::dmat4x3{1.0}, placed);
  for (const Placed& p : placed) {
    // Any entry that is not finite makes the determinant so, or the translation is it.
    const double det = glm::determinant(DMat3(p.world_from_object));
    if (!std::isfinite(det) || !finite(Vec3(p.world_from_object[3])))
      throw MeshFileError("the transform of a node is not finite");
  }
  return placed;
}

// STL has normals of triangles only, which is to say none.
bool wants_normals(const fs::path& file, const MeshFileOptions& options) {
  return options.normals == MeshNormals::file && lower_extension(file) != ".stl";
}

Mesh finished(MeshBuilder& builder, const MeshFileOptions& options) {
  Mesh mesh = builder.take();
  if (options.normals == MeshNormals::smooth) smooth_normals(mesh);
  return mesh;
}

[[noreturn]] void fail_empty() { throw MeshFileError("the file holds no triangles"); }

// assimp and the standard library throw what they like on broken files.
template <class Read>
auto guarded(const Read& read) {
  try {
    return read();
  } catch (const MeshFileError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw MeshFileError("out of memory");
  } catch (const std::exception& e) {
    throw MeshFileError(e.what());
  }
}

}  // namespace

const std::vector<std::string>& mesh_extensions() {
  static const std::vector<std::string> extensions{".obj", ".ply", ".stl", ".gltf", ".glb"};
  return extensions;
}

Mesh read_mesh(const fs::path& file, const MeshFileOptions& options) {
  return guarded([&] {
    const ImportedScene scene(file, options, false);
    const std::vector<Placed> placed = placed_meshes(*scene);
    bool normals = false;
    bool uvs = false;
    std::size_t triangles = 0;
    for (const Placed& p : placed) {
      normals |= wants_normals(file, options) && scene->mMeshes[p.mesh]->HasNormals();
      uvs |= has_uvs(*scene->mMeshes[p.mesh]);
      triangles += scene->mMeshes[p.mesh]->mNumFaces;
    }
    MeshBuilder builder(normals, uvs, std::min<std::size_t>(triangles, options.triangles));
    for (const Placed& p : placed)
      MeshReader(*scene->mMeshes[p.mesh], p.world_from_object)
          .read(normals, builder, options.triangles);
    if (builder.triangles() == 0) fail_empty();
    Mesh mesh = finished(builder, options);
    mesh.name = file.stem().string();
    return mesh;
  });
}

MeshFile read_mesh_file(const fs::path& file, const MeshFileOptions& options) {
  return guarded([&] {
    const ImportedScene scene(file, options, true);
    MeshFile result;
    std::vector<std::optional<MeshId>> ids(scene->mNumMeshes);
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
      const aiMesh& source = *scene->mMeshes[m];
      const bool normals = wants_normals(file, options) && source.HasNormals();
      MeshBuilder builder(normals, has_uvs(source), source.mNumFaces);
      MeshReader(source, glm::dmat4x3{1.0}).read(normals, builder, options.triangles);
      if (builder.triangles() == 0) continue;
      ids[m] = static_cast<MeshId>(result.meshes.size());
      result.meshes.push_back(finished(builder, options));
      result.meshes.back().name = source.mName.C_Str();
    }
    for (const Placed& p : placed_meshes(*scene))
      if (ids[p.mesh])
        result.parts.push_back(
            {*ids[p.mesh], scene->mMeshes[p.mesh]->mMaterialIndex, p.world_from_object});
    if (result.parts.empty()) fail_empty();
    read_materials(*scene, file, folder_of(file, options.folder), result);
    read_gltf_cameras_and_lights(scene.gltf(), result);
    return result;
  });
}

}  // namespace pah
