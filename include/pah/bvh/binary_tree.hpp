// The binary tree over boxes that the builder makes and from which BVHs are laid out.
#pragma once

#include <cstdint>
#include <pah/bvh/build_config.hpp>
#include <vector>

namespace pah {

// The builder splits by cost down to max_cost_depth and by halves below it, so that no input makes
// a tree deeper than max_depth. Traversal stacks are sized by it.
inline constexpr std::uint32_t max_cost_depth = 48;
inline constexpr std::uint32_t max_depth = max_cost_depth + 32;

struct BinaryTree {
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  // leaf: in `order`; inner node: the left child, the right one follows
    std::uint32_t count = 0;  // the leaf's triangles; 0 for an inner node

    [[nodiscard]] bool leaf() const { return count != 0; }
  };

  std::vector<Node> nodes;           // the root first, parents before children
  std::vector<std::uint32_t> order;  // indices of items; those of a leaf are contiguous

  [[nodiscard]] bool empty() const { return nodes.empty(); }
};

}  // namespace pah
