// glTF 2.0, checked here and read by assimp.
#pragma once

#include <filesystem>
#include <pah/io/mesh_file.hpp>

namespace pah {

// Adds the file's meshes and parts to `out`; of a file that is not merged, its materials, textures,
// cameras and lights too. Throws MeshFileError, or what the importer and the standard library do.
void import_gltf(const std::filesystem::path& file, const MeshFileOptions& options, MeshFile& out);

}  // namespace pah
