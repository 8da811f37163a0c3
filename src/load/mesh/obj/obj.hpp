// Reads Wavefront OBJ files: polygons, texture coordinates, normals and names of materials.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "load/mesh/common/polygon_mesh.hpp"

namespace pah {

struct ObjFile {
  PolygonMesh polygons;                // materials are indices of `materials`
  std::vector<std::string> materials;  // names; the first is empty, for faces without a material
  std::vector<std::string> libraries;  // .mtl files as written, one or several names each
  std::vector<std::string> warnings;
};

// Ignores points, lines, groups, smoothing groups and colors silently, and free-form curves and
// surfaces with a warning. Reads pieces of about `piece_bytes` in parallel; their size does not
// change the result. Throws MeshFileError, with line and column.
[[nodiscard]] ObjFile read_obj(const std::filesystem::path& file, const MeshFileOptions& options,
                               std::size_t piece_bytes = 1U << 17);

}  // namespace pah
