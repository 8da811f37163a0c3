// Reads the materials of glTF files.
#pragma once

#include <pah/load/mesh_file.hpp>
#include <string>
#include <vector>

#include "load/mesh/gltf/buffers.hpp"

namespace pah {

// Adds the materials, their emission and their textures to `out`, then the default material for
// primitives without one. Adds the names of unsupported features to `left_out`. Throws
// MeshFileError.
void read_gltf_materials(const GltfDocument& document, const GltfBuffers& buffers, MeshFile& out,
                         std::vector<std::string>& left_out);

}  // namespace pah
