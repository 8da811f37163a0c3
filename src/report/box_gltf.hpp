// A tree's boxes as a glTF 2.0 file for any viewer.
#pragma once

#include <pah/bvh/binary_tree.hpp>
#include <string>

namespace pah {

// The boxes of the first `count` levels as lines: a node, a mesh and a color for each level, so
// that viewers can switch them off. `origin` is added to the boxes' coordinates.
[[nodiscard]] std::string boxes_gltf(const BinaryTree& tree, std::uint32_t count,
                                     const DVec3& origin);

}  // namespace pah
