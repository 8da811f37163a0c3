// Reads the meshes of a glTF file.
#pragma once

#include "load/mesh/common/polygon_mesh.hpp"
#include "load/mesh/gltf/buffers.hpp"

namespace pah {

struct GltfPrimitive {
  std::size_t material;  // index in the file; the number of materials means the default one
  PolygonMesh polygons;  // empty for points and lines
};

// Returns the primitives of one mesh. Adds the names of unsupported features to `left_out`. Throws
// MeshFileError.
[[nodiscard]] std::vector<GltfPrimitive> read_gltf_mesh(const GltfDocument& document,
                                                        const GltfBuffers& buffers,
                                                        std::size_t mesh,
                                                        std::vector<std::string>& left_out);

// Adds `from`, transformed. A mirroring transform flips the winding.
void append(const PolygonMesh& from, const glm::dmat4x3& world_from_object, PolygonMesh& out);

}  // namespace pah
