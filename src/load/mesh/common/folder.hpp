// Limits the files that a mesh file may name to one folder and those below it.
#pragma once

#include <filesystem>
#include <string>

namespace pah {

// Returns whether `file` lies in or under `folder`, by its path: resolves `..`, but no links.
[[nodiscard]] bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder);

// Returns the folder that a mesh file is restricted to: `folder`, or the file's own if empty.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& file,
                                              const std::filesystem::path& folder);

// Returns the path of an image that the mesh file names relative to itself. Throws MeshFileError if
// it does not exist or lies outside `folder`.
[[nodiscard]] std::filesystem::path image_of(const std::filesystem::path& mesh_file,
                                             std::string name, const std::filesystem::path& folder);

}  // namespace pah
