// What has to hold in a glTF file before the importer may see it.
#pragma once

#include <cstdint>
#include <filesystem>

namespace pah {

// Checks that buffers, their views, accessors and indices lie within one another, that the nodes
// are a forest of bounded depth, and that every file named lies in or under `folder` and is not
// larger than `max_bytes`. Reads no images. Throws MeshFileError.
void check_gltf(const std::filesystem::path& file, const std::filesystem::path& folder,
                std::uint64_t max_bytes);

}  // namespace pah
