// A tree's boxes as lines.
#pragma once

#include <pah/bvh/binary_tree.hpp>
#include <string>
#include <vector>

#include "report/inspect/pictures/line_set.hpp"

namespace pah {

// The boxes of the first `count` levels.
[[nodiscard]] std::vector<LineSet> box_lines(const BinaryTree& tree, std::uint32_t count);

// They as a glTF file. `origin` is added to the boxes' coordinates.
[[nodiscard]] std::string boxes_gltf(const BinaryTree& tree, std::uint32_t count,
                                     const DVec3& origin);

}  // namespace pah
