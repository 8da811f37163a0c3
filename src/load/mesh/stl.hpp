// STL: triangles without shared vertices, ASCII or binary.
#pragma once

#include <filesystem>

#include "load/mesh/common/polygon_mesh.hpp"

namespace pah {

// Normals are left out: they are the triangles' own. Throws MeshFileError, with line and column
// where the file is text.
[[nodiscard]] PolygonMesh read_stl(const std::filesystem::path& file,
                                   const MeshFileOptions& options,
                                   std::vector<std::string>& warnings);

}  // namespace pah
