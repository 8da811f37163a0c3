#include "bvh/build.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "base/parallel_for.hpp"
#include "base/task_group.hpp"
#include "bvh/bins.hpp"

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

// A split, and what its items were sorted into to find it.
struct Found {
  Binning binning;
  Bins bins;
  std::vector<Bins> chunks;  // of large ranges
  Split split;
};

// Decides where to split, and sorts by it.
class Splitter {
 public:
  Splitter(const BuildConfig& config, const BuildHeuristic& heuristic)
      : bins_(std::clamp(config.bins, BuildConfig::min_bins, BuildConfig::max_bins)),
        max_leaf_(std::max(config.max_leaf, 1U)),
        side_by_side_(std::max(config.side_by_side, 1U)),
        least_share_(std::clamp(config.least_share, 0.0, 0.5)),
        leaves_(config.leaves),
        last_level_(config.leaves.levels > 0 ? std::min(config.leaves.levels, max_cost_depth)
                                             : max_cost_depth),
        heuristic_(heuristic) {}

  // Before any split.
  void begin(const Box4& root) {
    if (leaves_.cost > 0 || leaves_.area > 0 || leaves_.probability > 0)
      whole_ = heuristic_.whole > 0
                   ? heuristic_.whole
                   : static_cast<double>(measure_of(heuristic_.measure, root.aabb()));
  }

  // Nothing: a leaf.
  [[nodiscard, gnu::noinline]] std::optional<Parts> split(const Range& range, const Box4& box,
                                                          std::uint32_t depth) const {
    // The two boxes of a split cost more than so small a leaf.
    const bool leaf_allowed = range.count <= max_leaf_;
    if (leaf_allowed && leaf_cost(range.count, side_by_side_) <= 2 * box_cost) return std::nullopt;
    if (range.count == 1) return std::nullopt;
    if (leaf_allowed && is_leaf_by_rule(range.count, box)) return std::nullopt;
    const Box4 centroids = centroids_of(range.span());
    if (depth >= last_level_) {
      if (leaf_allowed) return std::nullopt;
      return halve(range, centroids);
    }

    const BuildHeuristic& heuristic =
        depth >= heuristic_.deeper_from ? *heuristic_.deeper : heuristic_;
    const Found found = heuristic.search
                            ? search(range, box, centroids, heuristic, *heuristic.search)
                            : find(range, centroids, heuristic.axes(box.aabb()), heuristic);
    const Split& best = found.split;
    if (leaf_allowed) {
      const float measure = measure_of(heuristic.measure, box.aabb());
      const float split_cost = 2 * box_cost * measure + best.cost;
      if (!(split_cost < leaf_cost(range.count, side_by_side_) * measure)) return std::nullopt;
    }
    if (best.bin == 0) return halve(range, centroids);
    const SplitBoxes sides = found.bins.at(best);
    partition(range, found.binning.side_of(best), sides.left_count, best, found.chunks);
    return parts_of(range.moved(), sides);
  }

 private:
  [[nodiscard]] bool is_leaf_by_rule(std::uint32_t count, const Box4& box) const {
    if (count < leaves_.triangles) return true;
    if (!(whole_ > 0)) return false;
    const double measure = measure_of(heuristic_.measure, box.aabb());
    const double probability = measure / whole_;
    return measure * heuristic_.square_meters < leaves_.area || probability < leaves_.probability ||
           probability * double{leaf_cost(count, side_by_side_)} < leaves_.cost;
  }

  [[nodiscard]] std::uint32_t least_of(std::uint32_t count) const {
    return std::max(1U, static_cast<std::uint32_t>(std::ceil(least_share_ * count)));
  }

  // The cheapest split of the axes.
  [[nodiscard]] Found find(const Range& range, const Box4& centroids, AxisMask axes,
                           const BuildHeuristic& heuristic) const {
    // Few items need few bins.
    const std::uint32_t bins_used = std::min(bins_, std::max(4U, 2 * range.count));
    const Binning binning(centroids, bins_used, axes);
    Found found{binning, Bins(bins_used), chunks_of(range, binning), {}};
    if (found.chunks.empty()) found.bins.add(range.span(), binning);
    for (const Bins& chunk : found.chunks) found.bins.add(chunk);
    found.split =
        heuristic.by_area() && least_share_ == 0
            ? found.bins.cheapest_by_area(binning, side_by_side_)
            : found.bins.cheapest(binning, heuristic.measure, side_by_side_, least_of(range.count));
    return found;
  }

  [[nodiscard]] Found search(const Range& range, const Box4& box, const Box4& centroids,
                             const BuildHeuristic& heuristic, const AxisSearch& search) const {
    const float whole = measure_of(heuristic.measure, box.aabb());
    std::unique_ptr<Found> best;
    const auto ratio = [&] {
      if (!best || best->split.bin == 0) return std::numeric_limits<double>::infinity();
      const SplitBoxes sides = best->bins.at(best->split);
      return (double{measure_of(heuristic.measure, sides.left.aabb())} +
              double{measure_of(heuristic.measure, sides.right.aabb())}) /
             double{whole};
    };
    const auto try_axes = [&](AxisMask axes) {
      Found found = find(range, centroids, axes, heuristic);
      if (!best || found.split.cost < best->split.cost)
        best = std::make_unique<Found>(std::move(found));
    };
    AxisMask good = 0, tried = 0;
    const std::array<RatedAxis, 3> rated = search.rate(box.aabb());
    for (const RatedAxis& one : rated)
      if (one.quality >= search.threshold) good |= 1U << static_cast<unsigned>(one.axis);
    if (search.excellent > 0) {
      for (const RatedAxis& one : rated) {
        const AxisMask axis = 1U << static_cast<unsigned>(one.axis);
        if ((good & axis) == 0 || ratio() <= search.excellent) break;
        try_axes(axis);
        tried |= axis;
      }
      if (ratio() <= search.excellent) return std::move(*best);
    } else if (good != 0) {  // nothing ends the search before
      try_axes(good);
      tried = good;
    }
    const AxisMask longest = longest_axis(box.aabb());
    if (good != all_axes && !(ratio() <= search.acceptable) && (tried & longest) == 0)
      try_axes(longest);
    if (!best) try_axes(longest);
    return std::move(*best);
  }

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
  double least_share_;
  LeafRules leaves_;
  std::uint32_t last_level_;
  const BuildHeuristic& heuristic_;
  double whole_ = 0;  // the measure of what all rays hit, where a rule asks
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
    const Box4 box = box_of(items);
    splitter_.begin(box);
    grow(root, {items.data(), room.data(), 0, count}, box, 0);
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
