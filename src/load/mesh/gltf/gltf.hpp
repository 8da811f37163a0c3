// Imports the meshes, materials, cameras and lights of one glTF 2.0 scene.
#pragma once

#include <filesystem>
#include <pah/load/mesh_file.hpp>

namespace pah {

// Adds the file's meshes and parts to `out`, and unless `options.merged` its materials, textures,
// cameras and lights. A warning names what is left out. Throws MeshFileError.
void import_gltf(const std::filesystem::path& file, const MeshFileOptions& options, MeshFile& out);

}  // namespace pah
