// A binary tree over boxes, as the builder makes it: the source from which kernels lay out theirs.
#pragma once

#include <cstdint>
#include <pah/bvh/build_config.hpp>
#include <vector>

namespace pah {

// The builder splits by cost down to this depth and by halves below it, so that no input, however
// lopsided, makes a tree deeper than max_depth: traversal stacks are sized by it.
inline constexpr std::uint32_t max_cost_depth = 48;
inline constexpr std::uint32_t max_depth = max_cost_depth + 32;

struct BinaryTree {
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  // leaf: of `order`; inner node: the left child, the right one follows
    std::uint32_t count = 0;  // of triangles; 0 for an inner node

    [[nodiscard]] bool leaf() const { return count != 0; }
  };

  std::vector<Node> nodes;           // the root first, parents before children; empty if nothing is
  std::vector<std::uint32_t> order;  // items, those of a leaf side by side

  [[nodiscard]] bool empty() const { return nodes.empty(); }
};

}  // namespace pah
