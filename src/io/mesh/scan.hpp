// What is wrong with the text of a mesh file, with line and column: the importers either do not say
// or do not notice.
#pragma once

#include <cstdint>
#include <filesystem>

namespace pah {

// Numbers that are not finite or no numbers, indices out of range, polygons of more than 10,000
// corners. Throws MeshFileError.
void scan_obj(const std::filesystem::path& file, std::uint64_t max_triangles);

// A PLY file that is cut short, numbers that are not finite, vertices that do not exist, and lists
// of more than 10,000 numbers. Throws MeshFileError.
void scan_ply(const std::filesystem::path& file);

}  // namespace pah
