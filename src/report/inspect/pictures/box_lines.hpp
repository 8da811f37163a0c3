// The boxes of a tree as lines.
#pragma once

#include <pah/bvh/binary_tree.hpp>
#include <vector>

#include "report/inspect/pictures/line_set.hpp"

namespace pah {

// The boxes of the first `count` levels, a set for each level.
[[nodiscard]] std::vector<LineSet> box_lines(const BinaryTree& tree, std::uint32_t count);

}  // namespace pah
