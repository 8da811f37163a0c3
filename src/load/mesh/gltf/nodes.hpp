// The nodes of a glTF file, which place its meshes, cameras and lights.
#pragma once

#include <pah/load/mesh_file.hpp>
#include <vector>

#include "load/mesh/gltf/json.hpp"

namespace pah {

struct GltfPlace {
  std::size_t mesh;
  glm::dmat4x3 world_from_object;
};

// Returns the places of the meshes in the document's scene, and adds its cameras and lights to
// `out`. glTF's lights are photometric (candela, lux); 683 lm/W converts them to watts. Throws
// MeshFileError.
[[nodiscard]] std::vector<GltfPlace> read_gltf_nodes(const Json& document, MeshFile& out);

}  // namespace pah
