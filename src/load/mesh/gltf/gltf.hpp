// glTF 2.0: meshes, materials, cameras and lights of one scene.
#pragma once

#include <filesystem>
#include <pah/load/mesh_file.hpp>

namespace pah {

// Adds the file's meshes and parts to `out`, and unless `options.merged` also its materials,
// textures, cameras and lights. Warns of unsupported features. Throws MeshFileError.
void import_gltf(const std::filesystem::path& file, const MeshFileOptions& options, MeshFile& out);

}  // namespace pah
