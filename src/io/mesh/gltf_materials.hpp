// The materials of glTF files, from assimp's terms into ours.
#pragma once

#include <assimp/scene.h>

#include <pah/io/mesh_file.hpp>

namespace pah {

[[nodiscard]] glm::dmat4x3 matrix_of(const aiMatrix4x4& m);

// Materials, their emission and textures. Images are files under `folder`. Throws MeshFileError.
void read_gltf_materials(const aiScene& scene, const std::filesystem::path& file,
                         const std::filesystem::path& folder, MeshFile& out);

}  // namespace pah
