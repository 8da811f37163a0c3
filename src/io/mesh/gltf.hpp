// What has to hold in a glTF file before the importer may see it, and what the importer's versions
// do not agree on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <pah/io/mesh_file.hpp>

namespace pah {

struct GltfDocument {
  // "scenes", "nodes", "cameras", "extensions"; none of a file that is no glTF.
  std::shared_ptr<const nlohmann::json> nodes;
  std::string cleaned;  // the file again, .gltf or .glb, with what importing needs
};

// Reads a .gltf or .glb, and checks that buffers, their views, accessors and indices lie within one
// another, that the nodes are a forest of bounded depth, and that every file named lies in or under
// `folder` and is not larger than `max_bytes`. Reads no images. Throws MeshFileError.
[[nodiscard]] GltfDocument read_gltf_document(const std::filesystem::path& file,
                                              const std::filesystem::path& folder,
                                              std::uint64_t max_bytes);

// Cameras and lights of the document's scene. glTF's lights are photometric (candela, lux): 683
// lm/W turn them into watts. Throws MeshFileError.
void read_gltf_cameras_and_lights(const GltfDocument& gltf, MeshFile& out);

// "%20" is a space, and so on.
[[nodiscard]] std::string decode_uri(std::string_view uri);

}  // namespace pah
