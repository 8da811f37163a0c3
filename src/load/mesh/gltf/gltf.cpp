#include "load/mesh/gltf/gltf.hpp"

#include <algorithm>
#include <map>

#include "load/mesh/common/folder.hpp"
#include "load/mesh/gltf/buffers.hpp"
#include "load/mesh/gltf/materials.hpp"
#include "load/mesh/gltf/meshes.hpp"
#include "load/mesh/gltf/nodes.hpp"

namespace pah {
namespace {

class Importer {
 public:
  Importer(const GltfDocument& document, const MeshFileOptions& options, MeshFile& out)
      : document_(document),
        options_(options),
        buffers_(document, 3 * options.triangles),
        out_(out) {}

  void run() {
    if (options_.merged)
      merge();
    else
      read_parts();
    for (const char* key : {"animations", "skins"})
      if (!list(document_.json, key).empty()) left_out_.emplace_back(key);
    tell_of_left_out();
  }

 private:
  // Reads each mesh once, even if several nodes use it.
  std::vector<GltfPrimitive> read(std::size_t mesh) {
    std::vector<GltfPrimitive> primitives = read_gltf_mesh(document_, buffers_, mesh, left_out_);
    for (const GltfPrimitive& primitive : primitives) {
      triangles_ += primitive.polygons.face_sizes.size();
      vertices_ += primitive.polygons.positions.size();
    }
    if (triangles_ > options_.triangles || vertices_ > 3 * options_.triangles)
      throw MeshFileError("more than " + std::to_string(options_.triangles) + " triangles");
    return primitives;
  }

  void merge() {
    PolygonMesh all;
    MeshFile ignored;
    for (const GltfPlace& place : read_gltf_nodes(document_.json, ignored))
      for (const GltfPrimitive& primitive : read(place.mesh))
        append(primitive.polygons, place.world_from_object, all);
    make_meshes(std::move(all), options_, out_);
  }

  void read_parts() {
    const std::vector<GltfPlace> places = read_gltf_nodes(document_.json, out_);
    std::map<std::size_t, std::vector<MeshFilePart>> parts;  // of each mesh, before its transform
    for (const GltfPlace& place : places) {
      const auto [entry, is_new] = parts.try_emplace(place.mesh);
      if (is_new) entry->second = make_parts(place.mesh);
      for (MeshFilePart part : entry->second) {
        part.world_from_object = place.world_from_object;
        out_.parts.push_back(part);
      }
    }
    read_gltf_materials(document_, buffers_, out_, left_out_);
  }

  std::vector<MeshFilePart> make_parts(std::size_t mesh) {
    std::vector<MeshFilePart> parts;
    for (const GltfPrimitive& primitive : read(mesh)) {
      MeshFile made;
      make_meshes(primitive.polygons, options_, made);
      if (made.meshes.empty()) continue;
      parts.push_back(
          {static_cast<MeshId>(out_.meshes.size()), static_cast<MaterialId>(primitive.material)});
      out_.meshes.push_back(std::move(made.meshes.front()));
      out_.meshes.back().name =
          list(document_.json, "meshes").at(mesh).value("name", std::string());
    }
    return parts;
  }

  void tell_of_left_out() {
    std::sort(left_out_.begin(), left_out_.end());
    left_out_.erase(std::unique(left_out_.begin(), left_out_.end()), left_out_.end());
    std::string names;
    for (const std::string& name : left_out_) names += (names.empty() ? "" : ", ") + name;
    if (!names.empty()) out_.warnings.push_back("left out: " + names);
  }

  const GltfDocument& document_;
  const MeshFileOptions& options_;
  GltfBuffers buffers_;
  MeshFile& out_;
  std::uint64_t triangles_ = 0;
  std::uint64_t vertices_ = 0;
  std::vector<std::string> left_out_;
};

}  // namespace

void import_gltf(const std::filesystem::path& file, const MeshFileOptions& options, MeshFile& out) {
  try {
    GltfDocument document =
        read_gltf_document(file, folder_of(file, options.folder), options.file_bytes);
    document.on_file = options.on_file;
    Importer(document, options, out).run();
  } catch (const Json::exception&) {
    throw MeshFileError("a value has a type that glTF does not allow");
  }
}

}  // namespace pah
