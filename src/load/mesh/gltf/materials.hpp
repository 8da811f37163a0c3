// The materials of glTF files.
#pragma once

#include <pah/load/mesh_file.hpp>
#include <string>
#include <vector>

#include "load/mesh/gltf/buffers.hpp"

namespace pah {

// Materials, their emission and textures into `out`, and behind them that of primitives without
// one. Names of what is left out go into `left_out`. Throws MeshFileError.
void read_gltf_materials(const GltfDocument& document, const GltfBuffers& buffers, MeshFile& out,
                         std::vector<std::string>& left_out);

}  // namespace pah
