// Analyzes trees without tracing rays (thesis, 5.2): by a visitor, or by a summary.
// pah/accel/trees.hpp returns the trees.
#pragma once

#include <pah/bvh/binary_tree.hpp>
#include <pah/bvh/box_measure.hpp>
#include <vector>

namespace pah {

// A node, as passed to a visitor.
struct NodeVisit {
  const BinaryTree& tree;
  std::uint32_t index = 0;
  std::uint32_t depth = 0;  // the root's is 0

  [[nodiscard]] const BinaryTree::Node& node() const { return tree.nodes[index]; }
  [[nodiscard]] const BinaryTree::Node& left() const { return tree.nodes[node().first]; }
  [[nodiscard]] const BinaryTree::Node& right() const { return tree.nodes[node().first + 1]; }
};

// Calls `per_node(visit)` for every node, breadth first, then returns the result of `at_end()`. The
// two functions keep whatever they gather.
template <typename PerNode, typename AtEnd>
auto visit_tree(const BinaryTree& tree, PerNode&& per_node, AtEnd&& at_end) {
  std::vector<std::uint32_t> level, below;
  if (!tree.empty()) level.push_back(0);
  for (std::uint32_t depth = 0; !level.empty(); ++depth) {
    below.clear();
    for (const std::uint32_t index : level) {
      per_node(NodeVisit{tree, index, depth});
      const BinaryTree::Node& node = tree.nodes[index];
      if (!node.leaf()) below.insert(below.end(), {node.first, node.first + 1});
    }
    level.swap(below);
  }
  return at_end();
}

struct TreeLevel {
  std::uint64_t nodes = 0;  // including leaves
  std::uint64_t leaves = 0;
  double overlap = 0;  // mean of sibling_overlap() over the inner nodes
};

// How evenly inner nodes divide their triangles. Counts nodes of at least `least_triangles`:
// smaller ones cannot be even.
struct TreeBalance {
  static constexpr std::uint32_t least_triangles = 64;
  static constexpr double lopsided_below = 1.0 / 16;

  std::uint64_t nodes = 0;  // those of at least `least_triangles`
  // The smaller child's share of a node's triangles, in (0, 0.5]: the mean and the least.
  double smaller_share = 0, smallest_share = 0;
  double lopsided = 0;  // the fraction of nodes whose smaller child has less than `lopsided_below`
};

struct TreeSummary {
  std::uint64_t triangles = 0;
  std::uint64_t nodes = 0;  // including leaves
  std::uint64_t leaves = 0;
  std::uint32_t max_depth = 0;
  double mean_depth = 0;                  // of leaves
  std::vector<std::uint64_t> leaf_sizes;  // [n]: the number of leaves of n triangles
  std::vector<TreeLevel> levels;          // by depth
  double overlap = 0;                     // mean over all inner nodes
  TreeBalance balance;
};

// The cost that the builder expects of a ray that hits the root's box.
[[nodiscard]] double expected_cost(const BinaryTree& tree, const BuildConfig& config,
                                   const BoxMeasure& measure);

// The measure of the intersection of an inner node's child boxes, relative to the measure of the
// node's box. 0 if the boxes do not touch.
[[nodiscard]] double sibling_overlap(const NodeVisit& visit, const BoxMeasure& measure);

[[nodiscard]] TreeBalance balance_of(const BinaryTree& tree);

[[nodiscard]] TreeSummary summarize(const BinaryTree& tree, const BoxMeasure& measure);

}  // namespace pah
