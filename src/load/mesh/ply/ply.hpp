// PLY, the Stanford polygon format: ASCII and binary.
#pragma once

#include <filesystem>

#include "load/mesh/common/polygon_mesh.hpp"

namespace pah {

// Reads positions, normals and texture coordinates of vertices (u and v, s and t, or texture_u and
// texture_v), faces with optional texture coordinates, and triangle strips. Ignores other
// properties silently. Data after the last element cause a warning. Throws MeshFileError, with line
// and column if the file is text.
[[nodiscard]] PolygonMesh read_ply(const std::filesystem::path& file,
                                   const MeshFileOptions& options,
                                   std::vector<std::string>& warnings);

}  // namespace pah
