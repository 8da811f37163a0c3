// Reads Wavefront OBJ files: polygons, texture coordinates, normals and names of materials.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "load/mesh/common/polygon_mesh.hpp"

namespace pah {

struct ObjFile {
  PolygonMesh polygons;                // materials are indices of `materials`
  std::vector<std::string> materials;  // names; the first, of faces without one, is empty
  std::vector<std::string> libraries;  // .mtl files, each one name or several, as written
  std::vector<std::string> warnings;
};

// Points, lines, groups, smoothing groups and colors are left out in silence, free-form curves and
// surfaces with a warning. The file is read in pieces of about `piece_bytes`, several at once;
// their size changes nothing. Throws MeshFileError, with line and column.
[[nodiscard]] ObjFile read_obj(const std::filesystem::path& file, const MeshFileOptions& options,
                               std::size_t piece_bytes = 1U << 17);

}  // namespace pah
