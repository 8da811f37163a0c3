#include "bvh/splitter.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <pah/bvh/binary_tree.hpp>

#include "base/parallel_for.hpp"

namespace pah {

namespace {

// Items per task of a pass over a large range.
constexpr std::size_t pass_grain = 16384;

// The box around `box_or_point(item)` of all items.
template <typename BoxOrPoint>
[[nodiscard]] Box4 box_around(std::span<const Item> items, const BoxOrPoint& box_or_point) {
  const auto box_of_chunk = [&](std::size_t first, std::size_t last) {
    Box4 box = Box4::empty();
    for (const Item& item : items.subspan(first, last - first)) box.extend(box_or_point(item));
    return box;
  };
  if (items.size() < 2 * pass_grain) return box_of_chunk(0, items.size());
  return parallel_fold(items.size(), pass_grain, Box4::empty(), box_of_chunk,
                       [](Box4& a, const Box4& b) { a.extend(b); });
}

[[nodiscard]] Box4 centroids_of(std::span<const Item> items) {
  return box_around(items, [](const Item& item) { return item.centroid(); });
}

// The bins of a large range's chunks. None for a small range: one chunk needs no joining.
[[nodiscard]] std::vector<Bins> chunks_of(const ItemRange& range, const Binning& binning) {
  if (range.count < 2 * pass_grain) return {};
  std::vector<Bins> chunks((range.count + pass_grain - 1) / pass_grain, Bins(binning.bins()));
  parallel_for(chunks.size(), 1, [&](std::size_t i) {
    const std::size_t first = i * pass_grain;
    const std::size_t size = std::min(pass_grain, range.count - first);
    chunks[i].add(range.span().subspan(first, size), binning);
  });
  return chunks;
}

[[nodiscard]] Halves halves_of(const ItemRange& range, const SplitBoxes& sides) {
  return {range.part(0, sides.left_count),
          range.part(sides.left_count, range.count - sides.left_count), sides.left, sides.right};
}

// Moves the items into the room. Each side keeps their order.
void partition(const ItemRange& range, const Side& side, std::uint32_t left_count,
               const Split& split, std::span<const Bins> chunks) {
  const auto move = [&](std::size_t first, std::size_t last, std::size_t left, std::size_t right) {
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

// Splits at the object median along the longest axis of the centroids. Ties go by index.
[[nodiscard]] Halves halve(const ItemRange& range, const Box4& centroids) {
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
  return halves_of(range, {half, box_of(items.first(half)), box_of(items.subspan(half))});
}

}  // namespace

AxisMask longest_axis(const Aabb& box) {
  const Vec3 size = box.extent();
  return size.x >= size.y && size.x >= size.z ? 0b001 : size.y >= size.z ? 0b010 : 0b100;
}

Box4 box_of(std::span<const Item> items) {
  return box_around(items, [](const Item& item) -> const Box4& { return item.box; });
}

// A split, and the bins from which it was chosen.
struct Splitter::BinnedSplit {
  Binning binning;
  Bins bins;
  std::vector<Bins> chunks;  // of large ranges
  Split split;
};

Splitter::Splitter(const BuildConfig& config, const BuildHeuristic& heuristic, const Box4& root)
    : bins_(std::clamp(config.bins, BuildConfig::min_bins, BuildConfig::max_bins)),
      max_leaf_(std::max(config.max_leaf, 1U)),
      side_by_side_(std::max(config.side_by_side, 1U)),
      least_share_(std::clamp(config.least_share, 0.0, 0.5)),
      leaves_(config.leaves),
      last_level_(config.leaves.levels > 0 ? std::min(config.leaves.levels, max_cost_depth)
                                           : max_cost_depth),
      heuristic_(heuristic) {
  if (leaves_.cost > 0 || leaves_.area > 0 || leaves_.probability > 0)
    whole_ = heuristic_.whole > 0
                 ? heuristic_.whole
                 : static_cast<double>(measure_of(heuristic_.measure, root.aabb()));
}

std::optional<Halves> Splitter::split(const ItemRange& range, const Box4& box,
                                      std::uint32_t depth) const {
  // Testing the two boxes of a split costs more than so small a leaf.
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
  const BinnedSplit best = heuristic.search
                               ? search(range, box, centroids, heuristic, *heuristic.search)
                               : cheapest(range, centroids, heuristic.axes(box.aabb()), heuristic);
  if (leaf_allowed) {
    const float measure = measure_of(heuristic.measure, box.aabb());
    const float split_cost = 2 * box_cost * measure + best.split.cost;
    if (!(split_cost < leaf_cost(range.count, side_by_side_) * measure)) return std::nullopt;
  }
  if (best.split.bin == 0) return halve(range, centroids);
  const SplitBoxes sides = best.bins.at(best.split);
  partition(range, best.binning.side_of(best.split), sides.left_count, best.split, best.chunks);
  return halves_of(range.moved(), sides);
}

bool Splitter::is_leaf_by_rule(std::uint32_t count, const Box4& box) const {
  if (count < leaves_.triangles) return true;
  if (!(whole_ > 0)) return false;
  const double measure = measure_of(heuristic_.measure, box.aabb());
  const double probability = measure / whole_;
  return measure * heuristic_.square_meters < leaves_.area || probability < leaves_.probability ||
         probability * double{leaf_cost(count, side_by_side_)} < leaves_.cost;
}

// The cheapest split along any of the axes.
Splitter::BinnedSplit Splitter::cheapest(const ItemRange& range, const Box4& centroids,
                                         AxisMask axes, const BuildHeuristic& heuristic) const {
  // Few items need few bins.
  const std::uint32_t bins_used = std::min(bins_, std::max(4U, 2 * range.count));
  const Binning binning(centroids, bins_used, axes);
  BinnedSplit best{binning, Bins(bins_used), chunks_of(range, binning), {}};
  if (best.chunks.empty()) best.bins.add(range.span(), binning);
  for (const Bins& chunk : best.chunks) best.bins.add(chunk);
  const auto least = static_cast<std::uint32_t>(std::ceil(least_share_ * range.count));
  best.split =
      heuristic.by_area() && least_share_ == 0
          ? best.bins.cheapest_by_area(binning, side_by_side_)
          : best.bins.cheapest(binning, heuristic.measure, side_by_side_, std::max(1U, least));
  return best;
}

// Tries the axes one after the other, as AxisSearch says.
Splitter::BinnedSplit Splitter::search(const ItemRange& range, const Box4& box,
                                       const Box4& centroids, const BuildHeuristic& heuristic,
                                       const AxisSearch& rules) const {
  const float whole = measure_of(heuristic.measure, box.aabb());
  std::unique_ptr<BinnedSplit> best;
  const auto ratio = [&] {
    if (!best || best->split.bin == 0) return std::numeric_limits<double>::infinity();
    const SplitBoxes sides = best->bins.at(best->split);
    return (double{measure_of(heuristic.measure, sides.left.aabb())} +
            double{measure_of(heuristic.measure, sides.right.aabb())}) /
           double{whole};
  };
  const auto try_axes = [&](AxisMask axes) {
    BinnedSplit split = cheapest(range, centroids, axes, heuristic);
    if (!best || split.split.cost < best->split.cost)
      best = std::make_unique<BinnedSplit>(std::move(split));
  };
  AxisMask good = 0, tried = 0;
  const std::array<RatedAxis, 3> rated = rules.rate(box.aabb());
  for (const RatedAxis& one : rated)
    if (one.quality >= rules.threshold) good |= 1U << static_cast<unsigned>(one.axis);
  if (rules.excellent > 0) {
    for (const RatedAxis& one : rated) {
      const AxisMask axis = 1U << static_cast<unsigned>(one.axis);
      if ((good & axis) == 0 || ratio() <= rules.excellent) break;
      try_axes(axis);
      tried |= axis;
    }
    if (ratio() <= rules.excellent) return std::move(*best);
  } else if (good != 0) {  // no split ends the search early: all good axes at once
    try_axes(good);
    tried = good;
  }
  const AxisMask longest = longest_axis(box.aabb());
  if (good != all_axes && !(ratio() <= rules.acceptable) && (tried & longest) == 0)
    try_axes(longest);
  if (!best) try_axes(longest);
  return std::move(*best);
}

}  // namespace pah
