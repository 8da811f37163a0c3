// What can be told of a tree without rays.
#pragma once

#include <vector>

#include "bvh/binary_tree.hpp"

namespace pah {

// A node as a visitor meets it.
struct NodeVisit {
  const BinaryTree& tree;
  std::uint32_t index = 0;
  std::uint32_t depth = 0;  // the root's is 0

  [[nodiscard]] const BinaryTree::Node& node() const { return tree.nodes[index]; }
  [[nodiscard]] const BinaryTree::Node& left() const { return tree.nodes[node().first]; }
  [[nodiscard]] const BinaryTree::Node& right() const { return tree.nodes[node().first + 1]; }
};

// Calls `per_node(visit)` for every node, breadth first, then returns what `at_end()` returns. What
// they gather they keep themselves, so anything can be gathered.
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
  std::uint64_t nodes = 0;  // leaves among them
  std::uint64_t leaves = 0;
  double overlap = 0;  // mean over the inner nodes; see sibling_overlap
};

struct TreeSummary {
  std::uint64_t triangles = 0;
  std::uint64_t nodes = 0;  // leaves among them
  std::uint64_t leaves = 0;
  std::uint32_t max_depth = 0;
  double mean_depth = 0;                  // of leaves
  std::vector<std::uint64_t> leaf_sizes;  // [n]: how many leaves have n triangles
  std::vector<TreeLevel> levels;          // by depth
  double overlap = 0;                     // mean over all inner nodes
  double expected_cost = 0;               // of a ray that hits the root's box
};

// The part of an inner node that both children claim: the measure of the intersection of their
// boxes, relative to that of the node's. 0 if they do not touch.
template <typename Heuristic>
[[nodiscard]] double sibling_overlap(const NodeVisit& visit, const Heuristic& heuristic) {
  const Aabb& left = visit.left().box;
  const Aabb& right = visit.right().box;
  const Aabb both{glm::max(left.min, right.min), glm::min(left.max, right.max)};
  const double whole = double{heuristic.area(visit.node().box)};
  return both.empty() || !(whole > 0) ? 0 : double{heuristic.area(both)} / whole;
}

template <typename Heuristic>
[[nodiscard]] TreeSummary summarize(const BinaryTree& tree, const BuildConfig& config,
                                    const Heuristic& heuristic) {
  TreeSummary sum;
  const auto per_node = [&](const NodeVisit& visit) {
    if (visit.depth == sum.levels.size()) sum.levels.emplace_back();
    TreeLevel& level = sum.levels[visit.depth];
    ++level.nodes;
    if (!visit.node().leaf()) {
      level.overlap += sibling_overlap(visit, heuristic);
      return;
    }
    const std::uint32_t size = visit.node().count;
    if (size >= sum.leaf_sizes.size()) sum.leaf_sizes.resize(size + std::size_t{1});
    ++sum.leaf_sizes[size];
    ++level.leaves;
    sum.triangles += size;
    sum.mean_depth += visit.depth;
  };
  const auto mean = [](double total, std::uint64_t count) {
    return count == 0 ? 0 : total / static_cast<double>(count);
  };
  return visit_tree(tree, per_node, [&] {
    for (TreeLevel& level : sum.levels) {
      sum.nodes += level.nodes;
      sum.leaves += level.leaves;
      sum.overlap += level.overlap;
      level.overlap = mean(level.overlap, level.nodes - level.leaves);
    }
    sum.max_depth = sum.levels.empty() ? 0 : static_cast<std::uint32_t>(sum.levels.size() - 1);
    sum.mean_depth = mean(sum.mean_depth, sum.leaves);
    sum.overlap = mean(sum.overlap, sum.nodes - sum.leaves);
    sum.expected_cost = expected_cost(tree, config, heuristic);
    return sum;
  });
}

}  // namespace pah
