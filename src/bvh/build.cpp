#include "bvh/build.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "bvh/bins.hpp"
#include "parallel/parallel_for.hpp"
#include "parallel/task_group.hpp"

namespace pah {

namespace {

// Ranges below these are not worth a task. The tree does not depend on the first.
constexpr std::uint32_t task_grain = 4096;
constexpr std::size_t pass_grain = 16384;

// Items, and as much room to move them to.
struct Range {
  Item* items;
  Item* room;
  std::uint32_t first;  // of the order
  std::uint32_t count;

  [[nodiscard]] std::span<Item> span() const { return {items, count}; }
  [[nodiscard]] Range part(std::uint32_t from, std::uint32_t size) const {
    return {items + from, room + from, first + from, size};
  }
  [[nodiscard]] Range moved() const { return {room, items, first, count}; }
};

struct Parts {
  Range left, right;
  Box4 left_box, right_box;
};

// Folds `add(partial, items)` over items.
template <typename Value, typename Add, typename Join>
[[nodiscard]] Value fold(std::span<const Item> items, const Value& zero, const Add& add,
                         const Join& join) {
  const auto serial = [&](std::size_t first, std::size_t last) {
    Value value = zero;
    add(value, items.subspan(first, last - first));
    return value;
  };
  if (items.size() < 2 * pass_grain) return serial(0, items.size());
  return parallel_fold(items.size(), pass_grain, zero, serial, join);
}

[[nodiscard]] Box4 box_of(std::span<const Item> items) {
  return fold(
      items, Box4::empty(),
      [](Box4& box, std::span<const Item> some) {
        for (const Item& item : some) box.extend(item.box);
      },
      [](Box4& a, const Box4& b) { a.extend(b); });
}

[[nodiscard]] Box4 centroids_of(std::span<const Item> items) {
  return fold(
      items, Box4::empty(),
      [](Box4& box, std::span<const Item> some) {
        for (const Item& item : some) box.extend(item.centroid());
      },
      [](Box4& a, const Box4& b) { a.extend(b); });
}

// Decides where to split, and sorts by it.
class Splitter {
 public:
  Splitter(const BuildConfig& config, const BuildHeuristic& heuristic)
      : bins_(std::clamp(config.bins, BuildConfig::min_bins, BuildConfig::max_bins)),
        max_leaf_(std::max(config.max_leaf, 1U)),
        side_by_side_(std::max(config.side_by_side, 1U)),
        heuristic_(heuristic),
        by_area_(heuristic.by_area()) {}

  // Nothing: a leaf.
  [[nodiscard, gnu::noinline]] std::optional<Parts> split(const Range& range, const Box4& box,
                                                          std::uint32_t depth) const {
    // The two boxes of a split cost more than so small a leaf.
    const bool leaf_allowed = range.count <= max_leaf_;
    if (leaf_allowed && leaf_cost(range.count, side_by_side_) <= 2 * box_cost) return std::nullopt;
    if (range.count == 1) return std::nullopt;
    const Box4 centroids = centroids_of(range.span());
    if (depth >= max_cost_depth) {
      if (leaf_allowed) return std::nullopt;
      return halve(range, centroids);
    }

    // Few items need few bins.
    const std::uint32_t bins_used = std::min(bins_, std::max(4U, 2 * range.count));
    const Binning binning(centroids, bins_used, heuristic_.axes(box.aabb()));
    Bins bins(bins_used);
    const std::vector<Bins> chunks = chunks_of(range, binning);
    if (chunks.empty()) bins.add(range.span(), binning);
    for (const Bins& chunk : chunks) bins.add(chunk);
    const Split best = by_area_ ? bins.cheapest_by_area(binning, side_by_side_)
                                : bins.cheapest(binning, heuristic_.measure, side_by_side_);
    if (leaf_allowed) {
      const float measure = measure_of(heuristic_.measure, box.aabb());
      const float split_cost = 2 * box_cost * measure + best.cost;
      if (!(split_cost < leaf_cost(range.count, side_by_side_) * measure)) return std::nullopt;
    }
    if (best.bin == 0) return halve(range, centroids);
    const SplitBoxes sides = bins.at(best);
    partition(range, binning.side_of(best), sides.left_count, best, chunks);
    return parts_of(range.moved(), sides);
  }

 private:
  // Nothing for small ranges: what is one chunk need not be joined.
  [[nodiscard]] static std::vector<Bins> chunks_of(const Range& range, const Binning& binning) {
    if (range.count < 2 * pass_grain) return {};
    std::vector<Bins> chunks((range.count + pass_grain - 1) / pass_grain, Bins(binning.bins()));
    parallel_for(chunks.size(), 1, [&](std::size_t i) {
      const std::size_t first = i * pass_grain;
      const std::size_t size = std::min(pass_grain, range.count - first);
      chunks[i].add(range.span().subspan(first, size), binning);
    });
    return chunks;
  }

  [[nodiscard]] static Parts parts_of(const Range& range, const SplitBoxes& sides) {
    return {range.part(0, sides.left_count),
            range.part(sides.left_count, range.count - sides.left_count), sides.left, sides.right};
  }

  // Moves the items into the room, each side in its order.
  static void partition(const Range& range, const Side& side, std::uint32_t left_count,
                        const Split& split, std::span<const Bins> chunks) {
    const auto move = [&](std::size_t first, std::size_t last, std::size_t left,
                          std::size_t right) {
      for (std::size_t i = first; i < last; ++i) {
        const bool to_right = side.is_right(range.items[i]);
        range.room[to_right ? right : left] = range.items[i];
        right += to_right ? 1 : 0;
        left += to_right ? 0 : 1;
      }
    };
    if (chunks.empty()) return move(0, range.count, 0, left_count);
    std::vector<std::size_t> lefts(chunks.size());
    std::transform_exclusive_scan(
        chunks.begin(), chunks.end(), lefts.begin(), std::size_t{0}, std::plus<>{},
        [&](const Bins& chunk) -> std::size_t { return chunk.at(split).left_count; });
    parallel_for(chunks.size(), 1, [&](std::size_t i) {
      const std::size_t first = i * pass_grain;
      const std::size_t last = std::min<std::size_t>(first + pass_grain, range.count);
      move(first, last, lefts[i], left_count + first - lefts[i]);
    });
  }

  // The object median along the longest axis of the centroids; ties by index.
  [[nodiscard]] static Parts halve(const Range& range, const Box4& centroids) {
    const int axis = std::countr_zero(longest_axis(centroids.aabb()));
    const std::span<Item> items = range.span();
    const std::uint32_t half = range.count / 2;
    if (centroids.max[axis] - centroids.min[axis] > 0) {
      std::nth_element(items.begin(), items.begin() + half, items.end(),
                       [axis](const Item& a, const Item& b) {
                         const float x = a.centroid()[axis];
                         const float y = b.centroid()[axis];
                         return x < y || (x == y && a.index() < b.index());
                       });
    }
    return parts_of(range, {half, box_of(items.first(half)), box_of(items.subspan(half))});
  }

  std::uint32_t bins_;
  std::uint32_t max_leaf_;
  std::uint32_t side_by_side_;
  const BuildHeuristic& heuristic_;
  bool by_area_;
};

using Node = BinaryTree::Node;

// A node and what is below it: two pieces that others may make, or all its nodes, in which inner
// nodes count from the first of them.
struct Piece {
  Node node;
  std::unique_ptr<std::array<Piece, 2>> sides;
  std::vector<Node> below;
};

class Builder {
 public:
  Builder(const BuildConfig& config, const BuildHeuristic& heuristic)
      : splitter_(config, heuristic) {}

  [[nodiscard]] BinaryTree build(std::span<Item> items, std::span<Item> room) {
    const auto count = static_cast<std::uint32_t>(items.size());
    tree_.order.resize(count);
    Piece root;
    grow(root, {items.data(), room.data(), 0, count}, box_of(items), 0);
    tasks_.wait();
    tree_.nodes.reserve(nodes_in(root));
    append(root, tree_.nodes.emplace_back());
    return std::move(tree_);
  }

 private:
  void make_leaf(Node& node, const Range& range) {
    node.first = range.first;
    node.count = range.count;
    for (std::uint32_t i = 0; i < range.count; ++i)
      tree_.order[range.first + i] = range.items[i].index();
  }

  void grow(Piece& piece, const Range& range, const Box4& box, std::uint32_t depth) {
    if (range.count < task_grain) {
      piece.below.reserve(range.count / 2);
      return subdivide(piece.node, piece.below, range, box, depth);
    }
    piece.node.box = box.aabb();
    const std::optional<Parts> parts = splitter_.split(range, box, depth);
    if (!parts) return make_leaf(piece.node, range);
    piece.sides = std::make_unique<std::array<Piece, 2>>();
    Piece& right = piece.sides->back();
    tasks_.run([this, &right, side = parts->right, side_box = parts->right_box, depth] {
      grow(right, side, side_box, depth + 1);
    });
    grow(piece.sides->front(), parts->left, parts->left_box, depth + 1);
  }

  // Depth-first, siblings side by side.
  Node subdivided(std::vector<Node>& nodes, const Range& range, const Box4& box,
                  std::uint32_t depth) {
    Node node;
    subdivide(node, nodes, range, box, depth);
    return node;
  }
  void subdivide(Node& node, std::vector<Node>& nodes, const Range& range, const Box4& box,
                 std::uint32_t depth) {
    node.box = box.aabb();
    const std::optional<Parts> parts = splitter_.split(range, box, depth);
    if (!parts) return make_leaf(node, range);
    const std::size_t first = nodes.size();
    node.first = static_cast<std::uint32_t>(first);
    nodes.resize(first + 2);
    nodes[first] = subdivided(nodes, parts->left, parts->left_box, depth + 1);
    nodes[first + 1] = subdivided(nodes, parts->right, parts->right_box, depth + 1);
  }

  [[nodiscard]] static std::size_t nodes_in(const Piece& piece) {
    if (!piece.sides) return 1 + piece.below.size();
    return 1 + nodes_in((*piece.sides)[0]) + nodes_in((*piece.sides)[1]);
  }

  // `slot` is in the tree, which has room for all: it stays where it is.
  void append(const Piece& piece, Node& slot) {
    slot = piece.node;
    if (slot.leaf()) return;
    std::vector<Node>& nodes = tree_.nodes;
    const auto first = static_cast<std::uint32_t>(nodes.size());
    if (piece.sides) {
      slot.first = first;
      nodes.resize(first + std::size_t{2});
      append((*piece.sides)[0], nodes[first]);
      append((*piece.sides)[1], nodes[first + 1]);
      return;
    }
    slot.first += first;
    for (Node node : piece.below) {
      if (!node.leaf()) node.first += first;
      nodes.push_back(node);
    }
  }

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
  return Builder(config, heuristic).build({&items[0], count}, {&items[count], count});
}

[[nodiscard]] std::vector<float> measures_of(const BinaryTree& tree, const BoxMeasure& measure) {
  constexpr std::size_t at_once = 512;
  std::vector<float> measures(tree.nodes.size());
  parallel_ranges(measures.size(), at_once, [&](std::size_t first, std::size_t last) {
    std::array<Aabb, at_once> boxes;
    for (std::size_t i = first; i < last; ++i) boxes[i - first] = tree.nodes[i].box;
    measure(std::span(boxes).first(last - first), std::span(measures).subspan(first, last - first));
  });
  return measures;
}

}  // namespace

AxisMask longest_axis(const Aabb& box) {
  const Vec3 size = box.extent();
  return size.x >= size.y && size.x >= size.z ? 0b001 : size.y >= size.z ? 0b010 : 0b100;
}

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
