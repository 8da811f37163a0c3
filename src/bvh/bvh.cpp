#include "bvh/bvh.hpp"

#include <algorithm>
#include <limits>

namespace pah {

namespace {

class Collapser {
 public:
  Collapser(const BinaryTree& tree, std::span<const float> areas, const Triangles& triangles,
            std::span<const std::uint32_t> subset)
      : tree_(tree), areas_(areas), triangles_(triangles), subset_(subset) {}

  [[nodiscard]] Bvh run() {
    if (tree_.empty()) return {};
    Children root{};
    if (tree_.nodes.front().leaf()) {
      root.add(0);  // a node of one child
    } else {
      root = open(0);
    }
    // Breadth first, so that the top of the tree, which every ray visits, lies together.
    std::vector<Children> queue{root};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const Children children = queue[i];
      BvhNode node{};
      for (std::size_t k = 0; k < BvhNode::width; ++k) {
        const bool used = k < children.count;
        const Aabb box = used ? node_box(tree_.nodes[children.nodes[k]].box) : Aabb{};
        for (int axis = 0; axis < 3; ++axis) {
          node.planes[axis][0][k] = box.min[axis];
          node.planes[axis][1][k] = box.max[axis];
        }
        if (!used) continue;
        const BinaryTree::Node& child = tree_.nodes[children.nodes[k]];
        if (child.leaf()) {
          node.children[k] = add_leaf(child);
        } else {
          node.children[k] = ChildRef::inner(static_cast<std::uint32_t>(queue.size()));
          queue.push_back(open(children.nodes[k]));
        }
      }
      bvh_.nodes.push_back(node);
    }
    bvh_.nodes.shrink_to_fit();
    bvh_.blocks.shrink_to_fit();
    return std::move(bvh_);
  }

 private:
  struct Children {
    std::array<std::uint32_t, BvhNode::width> nodes;
    std::size_t count;
    void add(std::uint32_t node) { nodes[count++] = node; }
  };

  // The children of a wide node: the largest inner node is replaced by its two, until it is full.
  [[nodiscard]] Children open(std::uint32_t node) const {
    Children children{};
    children.add(tree_.nodes[node].first);
    children.add(tree_.nodes[node].first + 1);
    while (children.count < BvhNode::width) {
      std::size_t largest = BvhNode::width;
      for (std::size_t k = 0; k < children.count; ++k) {
        if (tree_.nodes[children.nodes[k]].leaf()) continue;
        if (largest == BvhNode::width ||
            areas_[children.nodes[k]] > areas_[children.nodes[largest]]) {
          largest = k;
        }
      }
      if (largest == BvhNode::width) break;
      const std::uint32_t first = tree_.nodes[children.nodes[largest]].first;
      children.nodes[largest] = first;
      children.add(first + 1);
    }
    return children;
  }

  [[nodiscard]] ChildRef add_leaf(const BinaryTree::Node& leaf) {
    const std::size_t first_block = bvh_.blocks.size();
    constexpr auto width = static_cast<std::uint32_t>(TriangleBlock::width);
    for (std::uint32_t begin = 0; begin < leaf.count; begin += width) {
      TriangleBlock& block = bvh_.blocks.emplace_back();
      for (std::uint32_t lane = 0; lane < width; ++lane) {
        const std::uint32_t item = leaf.first + std::min(begin + lane, leaf.count - 1);
        const std::uint32_t index = subset_[tree_.order[item]];
        const Triangle triangle = triangles_[index];
        for (int axis = 0; axis < 3; ++axis) {
          block.vertices[0][axis][lane] = triangle.a[axis];
          block.vertices[1][axis][lane] = triangle.b[axis];
          block.vertices[2][axis][lane] = triangle.c[axis];
        }
        block.indices[lane] = index;
        const Aabb b = triangle.bounds();
        block.padding[lane] =
            triangle_padding * largest_of(glm::max(glm::abs(b.min), glm::abs(b.max)));
      }
    }
    return ChildRef::leaf(first_block, leaf.count);
  }

  const BinaryTree& tree_;
  std::span<const float> areas_;
  const Triangles& triangles_;
  std::span<const std::uint32_t> subset_;
  Bvh bvh_;
};

}  // namespace

Bvh collapse(const BinaryTree& tree, std::span<const float> areas, const Triangles& triangles,
             std::span<const std::uint32_t> subset) {
  return Collapser(tree, areas, triangles, subset).run();
}

}  // namespace pah
