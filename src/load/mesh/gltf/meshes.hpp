// Reads the meshes of a glTF file.
#pragma once

#include "load/mesh/common/polygon_mesh.hpp"
#include "load/mesh/gltf/buffers.hpp"

namespace pah {

struct GltfPrimitive {
  std::size_t material;  // as the file counts; its number of materials for the default one
  PolygonMesh polygons;  // none if it is points or lines
};

// Returns the primitives of one mesh. Adds the names of unsupported features to `left_out`. Throws
// MeshFileError.
[[nodiscard]] std::vector<GltfPrimitive> read_gltf_mesh(const GltfDocument& document,
                                                        const GltfBuffers& buffers,
                                                        std::size_t mesh,
                                                        std::vector<std::string>& left_out);

// Adds `from`, transformed and, where the transform mirrors, turned over.
void append(const PolygonMesh& from, const glm::dmat4x3& world_from_object, PolygonMesh& out);

}  // namespace pah
