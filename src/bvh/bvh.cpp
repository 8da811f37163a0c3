#include "bvh/bvh.hpp"

#include <algorithm>
#include <array>

#include "base/parallel_for.hpp"

namespace pah {

namespace {

// The children of a wide node, and the positions of its first inner node and first block.
struct Children {
  std::array<std::uint32_t, BvhNode::width> nodes;
  std::uint32_t count;
  std::uint32_t first_inner;
  std::size_t first_block;
};

class Collapser {
 public:
  Collapser(const BinaryTree& tree, std::span<const float> measures, const Triangles& triangles,
            std::span<const std::uint32_t> subset)
      : tree_(tree), measures_(measures), triangles_(triangles), subset_(subset) {}

  [[nodiscard]] Bvh run() {
    if (tree_.empty()) return {};
    choose();
    bvh_.nodes.resize(wide_.size());
    bvh_.blocks.resize(blocks_);
    parallel_for(wide_.size(), 256, [this](std::size_t i) { fill(i); });
    return std::move(bvh_);
  }

 private:
  // Chooses the wide nodes breadth first: the top of the tree, which every ray visits, is
  // contiguous.
  void choose() {
    wide_.reserve(tree_.nodes.size() / 4 + 1);
    wide_.push_back(tree_.nodes.front().leaf() ? Children{{0}, 1, 0, 0}  // a node of one child
                                               : open(0));
    for (std::size_t i = 0; i < wide_.size(); ++i) {
      wide_[i].first_inner = static_cast<std::uint32_t>(wide_.size());
      wide_[i].first_block = blocks_;
      const Children children = wide_[i];
      for (std::size_t k = 0; k < children.count; ++k) {
        const BinaryTree::Node& child = tree_.nodes[children.nodes[k]];
        if (child.leaf()) {
          blocks_ += blocks_of(child);
        } else {
          wide_.push_back(open(children.nodes[k]));
        }
      }
    }
  }

  // Replaces the inner node of the largest measure by its two children until the wide node is full.
  [[nodiscard]] Children open(std::uint32_t node) const {
    constexpr float never = -1;
    Children children{};
    std::array<float, BvhNode::width> measures;
    const auto put = [&](std::size_t at, std::uint32_t child) {
      children.nodes[at] = child;
      measures[at] = tree_.nodes[child].leaf() ? never : measures_[child];
    };
    put(0, tree_.nodes[node].first);
    put(1, tree_.nodes[node].first + 1);
    for (children.count = 2; children.count < BvhNode::width; ++children.count) {
      const auto* const largest =
          std::max_element(measures.begin(), measures.begin() + children.count);
      if (*largest == never) break;
      const auto opened = static_cast<std::size_t>(largest - measures.begin());
      const std::uint32_t first = tree_.nodes[children.nodes[opened]].first;
      put(opened, first);
      put(children.count, first + 1);
    }
    return children;
  }

  void fill(std::size_t i) {
    const Children& children = wide_[i];
    BvhNode& node = bvh_.nodes[i];
    std::uint32_t inner = children.first_inner;
    std::size_t block = children.first_block;
    for (std::size_t k = 0; k < BvhNode::width; ++k) {
      const bool used = k < children.count;
      const Aabb box = used ? tree_.nodes[children.nodes[k]].box : Aabb{};
      for (int axis = 0; axis < 3; ++axis) {
        node.planes[axis][0][k] = box.min[axis];
        node.planes[axis][1][k] = box.max[axis];
      }
      if (!used) continue;
      const BinaryTree::Node& child = tree_.nodes[children.nodes[k]];
      if (child.leaf()) {
        node.children[k] = ChildRef::leaf(block, child.count);
        fill_blocks(child, block);
        block += blocks_of(child);
      } else {
        node.children[k] = ChildRef::inner(inner++);
      }
    }
  }

  [[nodiscard]] static std::size_t blocks_of(const BinaryTree::Node& leaf) {
    return (leaf.count + TriangleBlock::width - 1) / TriangleBlock::width;
  }

  void fill_blocks(const BinaryTree::Node& leaf, std::size_t first_block) {
    constexpr auto width = static_cast<std::uint32_t>(TriangleBlock::width);
    for (std::uint32_t begin = 0; begin < leaf.count; begin += width) {
      TriangleBlock& block = bvh_.blocks[first_block++];
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
      }
    }
  }

  const BinaryTree& tree_;
  std::span<const float> measures_;
  const Triangles& triangles_;
  std::span<const std::uint32_t> subset_;
  std::vector<Children> wide_;
  std::size_t blocks_ = 0;
  Bvh bvh_;
};

}  // namespace

Bvh collapse(const BinaryTree& tree, std::span<const float> measures, const Triangles& triangles,
             std::span<const std::uint32_t> subset) {
  return Collapser(tree, measures, triangles, subset).run();
}

}  // namespace pah
