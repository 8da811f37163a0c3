// PLY, the Stanford polygon format: ASCII and binary.
#pragma once

#include <filesystem>

#include "load/mesh/common/polygon_mesh.hpp"

namespace pah {

// Positions, normals and texture coordinates of vertices (u and v, s and t, or texture_u and
// texture_v), faces with texture coordinates of their own if they have any, triangle strips; other
// properties are left out in silence. What stands behind the last element gets a warning. Throws
// MeshFileError, with line and column where the file is text.
[[nodiscard]] PolygonMesh read_ply(const std::filesystem::path& file,
                                   const MeshFileOptions& options,
                                   std::vector<std::string>& warnings);

}  // namespace pah
