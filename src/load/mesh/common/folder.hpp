// Limits the files that a mesh file may name to one folder and those below it.
#pragma once

#include <filesystem>
#include <string>

namespace pah {

// Whether `file` lies in or under `folder`, by its name alone: `..` is resolved, links are not.
[[nodiscard]] bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder);

// The folder that limits a mesh file: `folder`, or the file's own if that is empty.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& file,
                                              const std::filesystem::path& folder);

// The image that the mesh file names, relative to itself; it has to lie in or under `folder`.
// Throws MeshFileError.
[[nodiscard]] std::filesystem::path image_of(const std::filesystem::path& mesh_file,
                                             std::string name, const std::filesystem::path& folder);

}  // namespace pah
