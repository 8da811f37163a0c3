#include <algorithm>
#include <pah/load/mesh_file.hpp>

#include "base/extension.hpp"
#include "load/mesh/common/polygon_mesh.hpp"
#include "load/mesh/common/weld.hpp"
#include "load/mesh/gltf/gltf.hpp"
#include "load/mesh/obj/mtl.hpp"
#include "load/mesh/obj/obj.hpp"
#include "load/mesh/ply/ply.hpp"
#include "load/mesh/stl.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

// Throws unless the file exists and has a known extension.
void check_file(const fs::path& file) {
  const std::string extension = lower_extension(file);
  const auto& known = mesh_extensions();
  if (std::find(known.begin(), known.end(), extension) == known.end()) {
    std::string available;
    for (const std::string& name : known) available += (available.empty() ? "" : ", ") + name;
    throw MeshFileError("unknown mesh format '" + extension + "'; available are " + available);
  }
  std::error_code error;
  if (!fs::is_regular_file(file, error)) throw MeshFileError("it does not exist, or is not a file");
}

MeshFile read_format(const fs::path& file, const MeshFileOptions& options) {
  MeshFile result;
  const std::string extension = lower_extension(file);
  if (extension == ".obj") {
    ObjFile obj = read_obj(file, options);
    result.warnings = std::move(obj.warnings);
    make_meshes(std::move(obj.polygons), options, result);
    if (!options.merged) read_mtl_materials(obj, file, options, result);
  } else if (extension == ".ply") {
    make_meshes(read_ply(file, options, result.warnings), options, result);
  } else if (extension == ".stl") {
    make_meshes(read_stl(file, options, result.warnings), options, result);
  } else {
    import_gltf(file, options, result);
  }
  return result;
}

}  // namespace

const std::vector<std::string>& mesh_extensions() {
  static const std::vector<std::string> extensions{".obj", ".ply", ".stl", ".gltf", ".glb"};
  return extensions;
}

MeshFile read_mesh_file(const fs::path& file, const MeshFileOptions& options) {
  try {
    check_file(file);
    MeshFile result = read_format(file, options);
    if (result.parts.empty()) throw MeshFileError("the file holds no triangles");
    for (Mesh& mesh : result.meshes) {
      if (options.normals == MeshNormals::smooth) smooth_normals(mesh);
      if (mesh.name.empty()) mesh.name = file.stem().string();
    }
    if (result.materials.empty()) {
      result.materials.emplace_back();
      result.emission.push_back({.radiance = Vec3(0)});
    }
    return result;
  } catch (const MeshFileError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw MeshFileError("out of memory");
  } catch (const std::exception& e) {
    throw MeshFileError(e.what());
  }
}

Mesh read_mesh(const fs::path& file, MeshFileOptions options) {
  options.merged = true;
  return std::move(read_mesh_file(file, options).meshes.front());
}

}  // namespace pah
