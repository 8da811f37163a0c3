#include "bvh/build.hpp"

#include <array>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "base/parallel_for.hpp"
#include "base/task_group.hpp"
#include "bvh/splitter.hpp"

namespace pah {

namespace {

// Smaller ranges are not worth a task. The tree does not depend on this.
constexpr std::uint32_t task_grain = 4096;

using Node = BinaryTree::Node;

// A subtree: a root over two subtrees, which different threads may build, or a root and all nodes
// below it. Inner nodes of `below` index into `below`.
struct Subtree {
  Node root;
  std::unique_ptr<std::array<Subtree, 2>> children;
  std::vector<Node> below;
};

class TreeBuilder {
 public:
  TreeBuilder(std::span<Item> items, std::span<Item> room, const BuildConfig& config,
              const BuildHeuristic& heuristic)
      : items_(items), room_(room), box_(box_of(items)), splitter_(config, heuristic, box_) {}

  [[nodiscard]] BinaryTree build() {
    const auto count = static_cast<std::uint32_t>(items_.size());
    tree_.order.resize(count);
    Subtree root;
    grow(root, {items_.data(), room_.data(), 0, count}, box_, 0);
    tasks_.wait();
    tree_.nodes.reserve(nodes_in(root));
    append(root, tree_.nodes.emplace_back());
    return std::move(tree_);
  }

 private:
  void make_leaf(Node& node, const ItemRange& range) {
    node.first = range.first;
    node.count = range.count;
    for (std::uint32_t i = 0; i < range.count; ++i)
      tree_.order[range.first + i] = range.items[i].index();
  }

  void grow(Subtree& subtree, const ItemRange& range, const Box4& box, std::uint32_t depth) {
    if (range.count < task_grain) {
      subtree.below.reserve(range.count / 2);
      return subdivide(subtree.root, subtree.below, range, box, depth);
    }
    subtree.root.box = box.aabb();
    const std::optional<Halves> halves = splitter_.split(range, box, depth);
    if (!halves) return make_leaf(subtree.root, range);
    subtree.children = std::make_unique<std::array<Subtree, 2>>();
    Subtree& right = subtree.children->back();
    tasks_.run([this, &right, side = halves->right, side_box = halves->right_box, depth] {
      grow(right, side, side_box, depth + 1);
    });
    grow(subtree.children->front(), halves->left, halves->left_box, depth + 1);
  }

  // Appends the nodes below in depth-first order, siblings side by side.
  Node subdivided(std::vector<Node>& nodes, const ItemRange& range, const Box4& box,
                  std::uint32_t depth) {
    Node node;
    subdivide(node, nodes, range, box, depth);
    return node;
  }
  void subdivide(Node& node, std::vector<Node>& nodes, const ItemRange& range, const Box4& box,
                 std::uint32_t depth) {
    node.box = box.aabb();
    const std::optional<Halves> halves = splitter_.split(range, box, depth);
    if (!halves) return make_leaf(node, range);
    const std::size_t first = nodes.size();
    node.first = static_cast<std::uint32_t>(first);
    nodes.resize(first + 2);
    nodes[first] = subdivided(nodes, halves->left, halves->left_box, depth + 1);
    nodes[first + 1] = subdivided(nodes, halves->right, halves->right_box, depth + 1);
  }

  [[nodiscard]] static std::size_t nodes_in(const Subtree& subtree) {
    if (!subtree.children) return 1 + subtree.below.size();
    return 1 + nodes_in((*subtree.children)[0]) + nodes_in((*subtree.children)[1]);
  }

  // `slot` is a node of the tree. It does not move: the tree has room for all nodes.
  void append(const Subtree& subtree, Node& slot) {
    slot = subtree.root;
    if (slot.leaf()) return;
    std::vector<Node>& nodes = tree_.nodes;
    const auto first = static_cast<std::uint32_t>(nodes.size());
    if (subtree.children) {
      slot.first = first;
      nodes.resize(first + std::size_t{2});
      append((*subtree.children)[0], nodes[first]);
      append((*subtree.children)[1], nodes[first + 1]);
      return;
    }
    slot.first += first;
    for (Node node : subtree.below) {
      if (!node.leaf()) node.first += first;
      nodes.push_back(node);
    }
  }

  std::span<Item> items_, room_;
  Box4 box_;
  Splitter splitter_;
  BinaryTree tree_;
  TaskGroup tasks_;
};

template <typename BoxAt>
[[nodiscard]] BinaryTree build_from(std::size_t count, const BoxAt& box_at,
                                    const BuildConfig& config, const BuildHeuristic& heuristic) {
  if (count >> 31U != 0) throw std::length_error("there are too many boxes for one tree");
  if (count == 0) return {};
  const auto items = std::make_unique_for_overwrite<Item[]>(2 * count);
  parallel_for(count, task_grain,
               [&](std::size_t i) { items[i] = Item(box_at(i), static_cast<std::uint32_t>(i)); });
  return TreeBuilder({&items[0], count}, {&items[count], count}, config, heuristic).build();
}

[[nodiscard]] std::vector<float> measures_of(const BinaryTree& tree, const BoxMeasure& measure) {
  constexpr std::size_t batch_size = 512;
  std::vector<float> measures(tree.nodes.size());
  parallel_ranges(measures.size(), batch_size, [&](std::size_t first, std::size_t last) {
    std::array<Aabb, batch_size> boxes;
    for (std::size_t i = first; i < last; ++i) boxes[i - first] = tree.nodes[i].box;
    measure(std::span(boxes).first(last - first), std::span(measures).subspan(first, last - first));
  });
  return measures;
}

}  // namespace

BinaryTree build_tree(std::span<const Aabb> boxes, const BuildConfig& config,
                      const BuildHeuristic& heuristic) {
  return build_from(
      boxes.size(), [&](std::size_t i) { return boxes[i]; }, config, heuristic);
}

BuiltBvh build_bvh(const Triangles& triangles, std::span<const std::uint32_t> subset,
                   BuildConfig config, const BuildHeuristic& heuristic) {
  config.max_leaf = std::min(config.max_leaf, ChildRef::max_leaf);
  BinaryTree tree = build_from(
      subset.size(), [&](std::size_t i) { return padded(triangles[subset[i]].bounds()); }, config,
      heuristic);
  Bvh bvh = collapse(tree, measures_of(tree, heuristic.measure), triangles, subset);
  return {std::move(bvh), std::move(tree)};
}

BuiltBvh build_bvh(const Triangles& triangles) {
  std::vector<std::uint32_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  return build_bvh(triangles, all);
}

}  // namespace pah
