#include "bvh/build.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "parallel/parallel_for.hpp"
#include "parallel/task_group.hpp"

namespace pah {

namespace {

constexpr std::uint32_t max_bins = BuildConfig::max_bins;
// Ranges below this are not worth a task. The tree does not depend on it.
constexpr std::size_t parallel_grain = 4096;

struct Bin {
  Aabb box;
  std::uint32_t count = 0;

  void extend(const Bin& other) {
    box.extend(other.box);
    count += other.count;
  }
};

// Maps centroids to bins, per axis. An axis of no extent cannot be split: its scale is 0.
struct Binning {
  Vec3 origin{0};
  Vec3 scale{0};
  std::uint32_t bins = 0;

  Binning(const Aabb& centroids, std::uint32_t bin_count, AxisMask axes)
      : origin(centroids.min), bins(bin_count) {
    for (int axis = 0; axis < 3; ++axis) {
      const float s = static_cast<float>(bins) / (centroids.max[axis] - centroids.min[axis]);
      const bool usable = (axes >> axis & 1U) != 0 && s <= std::numeric_limits<float>::max();
      scale[axis] = usable ? s : 0;
    }
  }
  [[nodiscard]] std::uint32_t bin(float centroid, int axis) const {
    const float position = (centroid - origin[axis]) * scale[axis];
    return position < static_cast<float>(bins) ? static_cast<std::uint32_t>(position) : bins - 1;
  }
};

using Bins = std::array<std::array<Bin, max_bins>, 3>;

// What a sweep notes. Kept for each thread: clearing it costs more than most nodes do.
struct Halves {
  static constexpr std::size_t size = std::size_t{2} * max_bins;
  std::array<Aabb, size> boxes;
  std::array<std::uint32_t, size> counts;
  std::array<float, size> measures;
};

struct Split {
  float cost = std::numeric_limits<float>::infinity();
  int axis = 0;
  std::uint32_t bin = 0;  // the first of the right side
};

struct Item {
  Aabb box;
  std::uint32_t index;

  [[nodiscard]] Vec3 centroid() const { return box.center(); }
};

struct NodeBounds {
  Aabb box;
  Aabb centroids;

  void extend(const Item& item) {
    box.extend(item.box);
    centroids.extend(item.centroid());
  }
  void extend(const NodeBounds& other) {
    box.extend(other.box);
    centroids.extend(other.centroids);
  }
};

// Folds `add(partial, item)` over items.
template <typename Value, typename Add, typename Join>
[[nodiscard]] Value fold(std::span<const Item> items, const Value& zero, const Add& add,
                         const Join& join) {
  const auto serial = [&](std::size_t first, std::size_t last) {
    Value value = zero;
    for (std::size_t i = first; i < last; ++i) add(value, items[i]);
    return value;
  };
  if (items.size() < 4 * parallel_grain) return serial(0, items.size());
  return parallel_fold(items.size(), 4 * parallel_grain, zero, serial, join);
}

class Builder {
 public:
  Builder(std::vector<Item>& items, const BuildConfig& config, const BuildHeuristic& heuristic)
      : items_(items),
        bins_(std::clamp(config.bins, BuildConfig::min_bins, max_bins)),
        max_leaf_(std::max(config.max_leaf, 1U)),
        side_by_side_(std::max(config.side_by_side, 1U)),
        heuristic_(heuristic),
        // A subtree of n items has at most 2n - 1 nodes: each range has its own slots, so that
        // tasks need not agree on who takes which.
        nodes_(2 * items.size()) {}

  [[nodiscard]] BinaryTree build() {
    BinaryTree tree;
    if (items_.empty()) return tree;
    nodes_[0].box = bounds(items_).box;
    subdivide(0, 1, 0, static_cast<std::uint32_t>(items_.size()), 0);
    tasks_.wait();
    tree.order.resize(items_.size());
    for (std::size_t i = 0; i < items_.size(); ++i) tree.order[i] = items_[i].index;
    compact(tree);
    return tree;
  }

 private:
  [[nodiscard]] static NodeBounds bounds(std::span<const Item> items) {
    return fold(
        items, NodeBounds{}, [](NodeBounds& b, const Item& item) { b.extend(item); },
        [](NodeBounds& a, const NodeBounds& b) { a.extend(b); });
  }

  // Fills node `slot`; its descendants take slots from `free` on.
  void subdivide(std::uint32_t slot, std::uint32_t free, std::uint32_t first, std::uint32_t count,
                 std::uint32_t depth) {
    for (;;) {
      const std::span<Item> items(items_.data() + first, count);
      const NodeBounds node = bounds(items);
      nodes_[slot].box = node.box;
      const std::uint32_t left_count = count > 1 ? split(items, node, depth) : 0;
      if (left_count == 0) {
        nodes_[slot].first = first;
        nodes_[slot].count = count;
        return;
      }
      nodes_[slot].first = free;
      const std::uint32_t right_free = free + 2 + 2 * (left_count - 1);
      const std::uint32_t right_count = count - left_count;
      if (left_count >= parallel_grain && right_count >= parallel_grain) {
        tasks_.run([this, free, first, left_count, depth] {
          subdivide(free, free + 2, first, left_count, depth + 1);
        });
      } else {
        subdivide(free, free + 2, first, left_count, depth + 1);
      }
      slot = free + 1;
      free = right_free;
      first += left_count;
      count = right_count;
      ++depth;
    }
  }

  // Reorders the items into left and right; how many are left, or 0 to make a leaf.
  [[nodiscard]] std::uint32_t split(std::span<Item> items, const NodeBounds& node,
                                    std::uint32_t depth) const {
    const auto count = static_cast<std::uint32_t>(items.size());
    if (depth >= max_cost_depth) return count <= max_leaf_ ? 0 : halve(items, node.centroids);

    // Few items need few bins.
    const std::uint32_t bins = std::min(bins_, std::max(4U, 2 * count));
    const Binning binning(node.centroids, bins, heuristic_.axes(node.box));
    const Split best = cheapest(items, binning);
    const float measure = measure_of(heuristic_.measure, node.box);
    const float split_cost = 2 * box_cost * measure + best.cost;
    if (count <= max_leaf_ && !(split_cost < leaf_cost(count, side_by_side_) * measure)) return 0;
    if (best.bin == 0) return halve(items, node.centroids);

    const auto middle = std::partition(items.begin(), items.end(), [&](const Item& item) {
      return binning.bin(item.centroid()[best.axis], best.axis) < best.bin;
    });
    return static_cast<std::uint32_t>(middle - items.begin());
  }

  [[nodiscard]] Split cheapest(std::span<const Item> items, const Binning& binning) const {
    const Bins bins = fold(
        items, Bins{},
        [&](Bins& b, const Item& item) {
          const Vec3 centroid = item.centroid();
          for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = b[static_cast<std::size_t>(axis)][binning.bin(centroid[axis], axis)];
            bin.box.extend(item.box);
            ++bin.count;
          }
        },
        [&](Bins& a, const Bins& b) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::uint32_t i = 0; i < binning.bins; ++i) a[axis][i].extend(b[axis][i]);
          }
        });

    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (binning.scale[axis] > 0)
        sweep(bins[static_cast<std::size_t>(axis)], binning.bins, axis, best);
    }
    return best;
  }

  // Counts and boxes are swept from both ends; nothing is sorted.
  void sweep(const std::array<Bin, max_bins>& bins, std::uint32_t count, int axis,
             Split& best) const {
    // What would be left and right of a split before bin i stands at i - 1 of either half.
    const std::uint32_t splits = count - 1;
    static thread_local Halves halves;
    auto& [boxes, counts, measures] = halves;
    Bin right;
    for (std::uint32_t i = splits; i > 0; --i) {
      right.extend(bins[i]);
      boxes[splits + i - 1] = right.box;
      counts[splits + i - 1] = right.count;
    }
    Bin left;
    for (std::uint32_t i = 0; i < splits; ++i) {
      left.extend(bins[i]);
      boxes[i] = left.box;
      counts[i] = left.count;
    }
    const std::size_t used = std::size_t{2} * splits;
    heuristic_.measure(std::span(boxes).first(used), std::span(measures).first(used));
    for (std::uint32_t i = 0; i < splits; ++i) {
      if (counts[i] == 0 || counts[splits + i] == 0) continue;
      const float right_cost = measures[splits + i] * leaf_cost(counts[splits + i], side_by_side_);
      const float cost = measures[i] * leaf_cost(counts[i], side_by_side_) + right_cost;
      if (cost < best.cost) best = {cost, axis, i + 1};
    }
  }

  // The object median along the longest axis of the centroids; ties by index.
  [[nodiscard]] static std::uint32_t halve(std::span<Item> items, const Aabb& centroids) {
    const int axis = std::countr_zero(longest_axis(centroids));
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    if (centroids.extent()[axis] > 0) {
      std::nth_element(items.begin(), middle, items.end(), [axis](const Item& a, const Item& b) {
        const float x = a.centroid()[axis];
        const float y = b.centroid()[axis];
        return x < y || (x == y && a.index < b.index);
      });
    }
    return static_cast<std::uint32_t>(items.size() / 2);
  }

  // Depth-first, siblings side by side.
  void compact(BinaryTree& tree) const {
    tree.nodes.reserve(nodes_.size());
    tree.nodes.push_back(nodes_[0]);
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      BinaryTree::Node& node = tree.nodes[at];
      if (node.leaf()) continue;
      const std::uint32_t from = node.first;
      node.first = static_cast<std::uint32_t>(tree.nodes.size());
      open.push_back(node.first + 1);
      open.push_back(node.first);
      tree.nodes.push_back(nodes_[from]);
      tree.nodes.push_back(nodes_[from + 1]);
    }
    tree.nodes.shrink_to_fit();
  }

  std::vector<Item>& items_;
  std::uint32_t bins_;
  std::uint32_t max_leaf_;
  std::uint32_t side_by_side_;
  const BuildHeuristic& heuristic_;
  std::vector<BinaryTree::Node> nodes_;
  TaskGroup tasks_;
};

}  // namespace

AxisMask longest_axis(const Aabb& box) {
  const Vec3 size = box.extent();
  return size.x >= size.y && size.x >= size.z ? 0b001 : size.y >= size.z ? 0b010 : 0b100;
}

BinaryTree build_tree(std::span<const Aabb> boxes, const BuildConfig& config,
                      const BuildHeuristic& heuristic) {
  if (boxes.size() >> 31U != 0) throw std::length_error("there are too many boxes for one tree");
  std::vector<Item> items(boxes.size());
  parallel_for(boxes.size(), parallel_grain, [&](std::size_t i) {
    items[i] = {boxes[i], static_cast<std::uint32_t>(i)};
  });
  return Builder(items, config, heuristic).build();
}

BuiltBvh build_bvh(const Triangles& triangles, std::span<const std::uint32_t> subset,
                   BuildConfig config, const BuildHeuristic& heuristic) {
  config.max_leaf = std::min(config.max_leaf, ChildRef::max_leaf);
  std::vector<Aabb> boxes(subset.size());
  parallel_for(boxes.size(), parallel_grain,
               [&](std::size_t i) { boxes[i] = padded(triangles[subset[i]].bounds()); });
  BinaryTree tree = build_tree(boxes, config, heuristic);
  boxes.resize(tree.nodes.size());
  std::ranges::transform(tree.nodes, boxes.begin(), &BinaryTree::Node::box);
  std::vector<float> measures(boxes.size());
  heuristic.measure(boxes, measures);
  Bvh bvh = collapse(tree, measures, triangles, subset);
  return {std::move(bvh), std::move(tree)};
}

BuiltBvh build_bvh(const Triangles& triangles) {
  std::vector<std::uint32_t> all(triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  return build_bvh(triangles, all);
}

}  // namespace pah
