#include "io/mesh/gltf_import.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <pah/scene/placement.hpp>

#include "io/mesh/folder.hpp"
#include "io/mesh/gltf.hpp"
#include "io/mesh/gltf_materials.hpp"
#include "io/mesh/limited_files.hpp"
#include "io/mesh/polygon_mesh.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

// Leaves the importer of glTF 2.0, whatever the file looks like inside.
void keep_importer(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    if (std::string(importer.GetImporterInfo(i)->mName) == "glTF2 Importer") continue;
    // An importer that is unregistered is no longer owned by anyone.
    const std::unique_ptr<Assimp::BaseImporter> unwanted(importer.GetImporter(i));
    importer.UnregisterLoader(unwanted.get());
  }
}

// What assimp read, checked: every index is in range, and only triangles count.
class ImportedScene {
 public:
  ImportedScene(const fs::path& file, const MeshFileOptions& options);

  [[nodiscard]] const aiScene& operator*() const { return *scene_; }
  [[nodiscard]] const GltfDocument& gltf() const { return gltf_; }

 private:
  void check(const MeshFileOptions& options) const;

  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
  GltfDocument gltf_;
};

ImportedScene::ImportedScene(const fs::path& file, const MeshFileOptions& options) {
  const fs::path folder = folder_of(file, options.folder);
  gltf_ = read_gltf_document(file, folder, options.file_bytes);
  // The importer owns it.
  auto* const files = new LimitedFiles(file, gltf_.cleaned, folder, options.file_bytes);
  importer_.SetIOHandler(files);
  keep_importer(importer_);
  scene_ = importer_.ReadFile(file.string(), 0);
  if (!files->refusal().empty()) throw MeshFileError(files->refusal());
  if (scene_ == nullptr) throw MeshFileError(importer_.GetErrorString());
  check(options);
}

void ImportedScene::check(const MeshFileOptions& options) const {
  std::uint64_t triangles = 0;
  for (unsigned m = 0; m < scene_->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene_->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned k = 0; k < face.mNumIndices; ++k)
        if (face.mIndices[k] >= mesh.mNumVertices)
          throw MeshFileError("face " + std::to_string(f) + " uses vertex " +
                              std::to_string(face.mIndices[k]) + " of " +
                              std::to_string(mesh.mNumVertices));
      triangles += face.mNumIndices == 3 ? 1 : 0;
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

[[noreturn]] void fail_at(std::uint32_t vertex, const char* what) {
  throw MeshFileError("the " + std::string(what) + " of vertex " + std::to_string(vertex) +
                      " is not finite");
}

// Adds an aiMesh, transformed.
void append(const aiMesh& mesh, const glm::dmat4x3& world_from_object, PolygonMesh& out) {
  const DMat3 m(world_from_object);
  const bool moves = world_from_object != glm::dmat4x3{1.0};
  const bool mirrors = glm::determinant(m) < 0;
  const double sign = mirrors ? -1 : 1;
  const DMat3 normal_matrix(sign * glm::cross(m[1], m[2]), sign * glm::cross(m[2], m[0]),
                            sign * glm::cross(m[0], m[1]));
  const bool has_uvs = mesh.HasTextureCoords(0) && mesh.mNumUVComponents[0] >= 2;
  const auto first = static_cast<std::uint32_t>(out.vertices.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    PolygonVertex vertex{static_cast<std::uint32_t>(out.positions.size()), no_index, no_index};
    Vec3 position = vec(mesh.mVertices[i]);
    if (moves) position = Vec3(world_from_object * glm::dvec4(DVec3(position), 1));
    if (!finite(position)) fail_at(i, "position");
    out.positions.push_back(position);
    if (has_uvs) {
      const aiVector3D& uv = mesh.mTextureCoords[0][i];
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) fail_at(i, "texture coordinate");
      vertex.uv = static_cast<std::uint32_t>(out.uvs.size());
      out.uvs.emplace_back(uv.x, uv.y);
    }
    if (mesh.HasNormals()) {
      const Vec3 given = vec(mesh.mNormals[i]);
      const Vec3 normal = moves ? Vec3(normal_matrix * DVec3(given)) : given;
      // Files have such normals where triangles have no area.
      if (finite(normal)) {
        vertex.normal = static_cast<std::uint32_t>(out.normals.size());
        out.normals.push_back(normal);
      }
    }
    out.vertices.push_back(vertex);
  }
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;  // a point or a line
    for (unsigned k = 0; k < 3; ++k)
      out.corners.push_back(first + face.mIndices[mirrors ? (3 - k) % 3 : k]);
    out.face_sizes.push_back(3);
  }
}

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

// All as one mesh, the transforms of nodes applied.
void merge(const aiScene& scene, const MeshFileOptions& options, MeshFile& out) {
  PolygonMesh polygons;
  for (const Placed& p : placed_meshes(scene))
    append(*scene.mMeshes[p.mesh], p.world_from_object, polygons);
  make_meshes(polygons, options, out);
}

// One mesh for each of the file's, where its nodes put it.
void read_parts(const aiScene& scene, const MeshFileOptions& options, MeshFile& out) {
  std::vector<std::optional<MeshId>> ids(scene.mNumMeshes);
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    PolygonMesh polygons;
    append(*scene.mMeshes[m], glm::dmat4x3{1.0}, polygons);
    MeshFile made;
    make_meshes(polygons, options, made);
    if (made.meshes.empty()) continue;
    ids[m] = static_cast<MeshId>(out.meshes.size());
    out.meshes.push_back(std::move(made.meshes.front()));
    out.meshes.back().name = scene.mMeshes[m]->mName.C_Str();
  }
  for (const Placed& p : placed_meshes(scene))
    if (ids[p.mesh])
      out.parts.push_back(
          {*ids[p.mesh], scene.mMeshes[p.mesh]->mMaterialIndex, p.world_from_object});
}

}  // namespace

void import_gltf(const fs::path& file, const MeshFileOptions& options, MeshFile& out) {
  const ImportedScene scene(file, options);
  if (options.merged) return merge(*scene, options, out);
  read_parts(*scene, options, out);
  read_gltf_materials(*scene, file, folder_of(file, options.folder), out);
  read_gltf_cameras_and_lights(scene.gltf(), out);
}

}  // namespace pah
