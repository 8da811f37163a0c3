#include "bvh/bvh.hpp"

#include <limits>

namespace pah {

namespace {

void set_child(BvhNode& node, int side, const BinaryTree::Node& child, std::uint32_t inner_index) {
  for (int axis = 0; axis < 3; ++axis) {
    node.planes[axis][side] = child.box.min[axis];
    node.planes[axis][side + 2] = child.box.max[axis];
  }
  node.first[side] = child.leaf() ? child.first : inner_index;
  node.count[side] = child.count;
}

}  // namespace

Bvh::Bvh(const BinaryTree& tree, const Triangles& triangles,
         std::span<const std::uint32_t> subset) {
  if (tree.empty()) return;
  triangles_.reserve(tree.order.size());
  for (const std::uint32_t item : tree.order) {
    triangles_.push_back({triangles[subset[item]], subset[item]});
  }

  // Inner nodes keep their order.
  std::vector<std::uint32_t> inner_index(tree.nodes.size());
  std::uint32_t inner_count = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (!tree.nodes[i].leaf()) inner_index[i] = inner_count++;
  }
  if (inner_count == 0) {
    BvhNode& root = nodes_.emplace_back();
    set_child(root, 0, tree.nodes.front(), 0);
    set_child(root, 1, BinaryTree::Node{}, 0);  // an empty box: never entered
    return;
  }
  nodes_.resize(inner_count);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const BinaryTree::Node& from = tree.nodes[i];
    if (from.leaf()) continue;
    for (int side = 0; side < 2; ++side) {
      const std::uint32_t child = from.first + static_cast<std::uint32_t>(side);
      set_child(nodes_[inner_index[i]], side, tree.nodes[child], inner_index[child]);
    }
  }
}

}  // namespace pah
