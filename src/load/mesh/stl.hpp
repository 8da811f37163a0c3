// STL: triangles without shared vertices, ASCII or binary.
#pragma once

#include <filesystem>

#include "load/mesh/common/polygon_mesh.hpp"

namespace pah {

// Ignores normals: those of STL files are the triangles' geometric normals. Throws MeshFileError,
// with line and column if the file is text.
[[nodiscard]] PolygonMesh read_stl(const std::filesystem::path& file,
                                   const MeshFileOptions& options,
                                   std::vector<std::string>& warnings);

}  // namespace pah
