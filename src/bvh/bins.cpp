#include "bvh/bins.hpp"

namespace pah {

namespace {

// leaf_cost() in each lane. The number of rounds is exact below 2^24 items; above, its error does
// not matter.
[[gnu::always_inline]] inline Float4 leaf_costs(Int4 counts, Float4 side_by_side) {
  const Float4 items = __builtin_convertvector(counts, Float4) + (side_by_side - 1);
  const Int4 rounds = __builtin_convertvector(items / side_by_side, Int4);
  return triangle_cost * __builtin_convertvector(rounds, Float4);
}

using Boxes = std::array<Box4, 3>;

// SurfaceArea of three boxes, rounded the same way; infinite for empty boxes.
[[gnu::always_inline]] inline Float4 areas(const Boxes& boxes) {
  const Float4 a = boxes[0].max - boxes[0].min;
  const Float4 b = boxes[1].max - boxes[1].min;
  const Float4 c = boxes[2].max - boxes[2].min;
  const Float4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Float4 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Float4 x = __builtin_shufflevector(ab_low, c, 0, 1, 4, 5);
  const Float4 y = __builtin_shufflevector(ab_low, c, 2, 3, 5, 5);
  const Float4 z = __builtin_shufflevector(ab_high, c, 0, 1, 6, 6);
  return x * y + y * z + z * x;
}

[[gnu::always_inline]] inline void extend(Boxes& boxes, const Boxes& others) {
  for (std::size_t k = 0; k < boxes.size(); ++k) boxes[k].extend(others[k]);
}

Boxes empty_boxes() { return {Box4::empty(), Box4::empty(), Box4::empty()}; }

}  // namespace

Binning::Binning(const Box4& centroids, std::uint32_t bins, AxisMask axes)
    : origin_(centroids.min),
      scale_(static_cast<float>(bins) / (centroids.max - centroids.min)),
      last_(splat(static_cast<float>(bins - 1))),
      bins_(bins) {
  for (int axis = 0; axis < 4; ++axis) {
    const bool usable = axis < 3 && (axes >> static_cast<unsigned>(axis) & 1U) != 0 &&
                        scale_[axis] <= std::numeric_limits<float>::max();
    if (!usable) scale_[axis] = 0;
  }
}

void Bins::clear(std::uint32_t bins) {
  used_ = bins;
  for (std::uint32_t i = 0; i < bins; ++i) {
    boxes_[i] = empty_boxes();
    counts_[i] = {};
  }
}

[[gnu::always_inline]] inline void Bins::add(const Item& item, const Binning& binning) {
  const Int4 bins = binning.bins_of(item);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const auto bin = static_cast<std::size_t>(bins[static_cast<int>(axis)]);
    boxes_[bin][axis].extend(item.box);
    ++counts_[bin][axis];
  }
}

void Bins::add(std::span<const Item> items, const Binning& binning) {
  // Consecutive items often fall into the same bin, and the second would wait for the first: large
  // ranges alternate between two sets of bins.
  constexpr std::size_t worth_two = 96;
  std::size_t i = 0;
  if (items.size() >= worth_two) {
    Bins other(used_);
    for (; i + 1 < items.size(); i += 2) {
      add(items[i], binning);
      other.add(items[i + 1], binning);
    }
    add(other);
  }
  for (; i < items.size(); ++i) add(items[i], binning);
}

void Bins::add(const Bins& other) {
  for (std::uint32_t i = 0; i < used_; ++i) {
    extend(boxes_[i], other.boxes_[i]);
    for (std::size_t axis = 0; axis < axes; ++axis) counts_[i][axis] += other.counts_[i][axis];
  }
}

Split Bins::cheapest(const Binning& binning, const BoxMeasure& measure, std::uint32_t side_by_side,
                     std::uint32_t least) const {
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    if (binning.splits(axis)) sweep(axis, measure, side_by_side, least, best);
  }
  return best;
}

// Sweeps the bins from both ends, one lane per axis. A side without items costs infinity * 0 = NaN,
// which never compares as cheaper.
Split Bins::cheapest_by_area(const Binning& binning, std::uint32_t side_by_side) const {
  const Float4 rounds_of = splat(static_cast<float>(side_by_side));
  std::array<Float4, BuildConfig::max_bins> right_costs;
  Boxes boxes = empty_boxes();
  Int4 counts{};
  for (std::uint32_t i = used_ - 1; i > 0; --i) {
    extend(boxes, boxes_[i]);
    counts += counts_of(i);
    right_costs[i] = areas(boxes) * leaf_costs(counts, rounds_of);
  }
  boxes = empty_boxes();
  counts = Int4{};
  Float4 costs = splat(std::numeric_limits<float>::infinity());
  Int4 bins{};
  for (std::uint32_t i = 1; i < used_; ++i) {
    extend(boxes, boxes_[i - 1]);
    counts += counts_of(i - 1);
    const Float4 cost = areas(boxes) * leaf_costs(counts, rounds_of) + right_costs[i];
    const Int4 cheaper = cost < costs;
    costs = min(cost, costs);
    const auto bin = static_cast<std::int32_t>(i);
    bins = (cheaper & bin) | (~cheaper & bins);
  }
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    if (binning.splits(axis) && costs[axis] < best.cost)
      best = {costs[axis], axis, static_cast<std::uint32_t>(bins[axis])};
  }
  return best;
}

void Bins::sweep(int axis, const BoxMeasure& measure, std::uint32_t side_by_side,
                 std::uint32_t least, Split& best) const {
  // Of a split before bin i, entry i - 1 of the first half describes the left side, entry i - 1 of
  // the second half the right side.
  constexpr std::size_t size = std::size_t{2} * BuildConfig::max_bins;
  // One per thread: initializing it costs more than sweeping most nodes.
  static thread_local std::array<Aabb, size> boxes;
  std::array<std::uint32_t, size> counts;
  std::array<float, size> measures;
  const std::uint32_t splits = used_ - 1;
  const auto note = [&](std::uint32_t at, std::uint32_t bin, Box4& box, std::uint32_t& count) {
    box.extend(boxes_[bin][static_cast<std::size_t>(axis)]);
    count += counts_[bin][static_cast<std::size_t>(axis)];
    boxes[at] = box.aabb();
    counts[at] = count;
  };
  Box4 right = Box4::empty(), left = Box4::empty();
  std::uint32_t right_count = 0, left_count = 0;
  for (std::uint32_t i = splits; i > 0; --i) note(splits + i - 1, i, right, right_count);
  for (std::uint32_t i = 0; i < splits; ++i) note(i, i, left, left_count);
  const std::size_t noted = std::size_t{2} * splits;
  measure(std::span(boxes).first(noted), std::span(measures).first(noted));
  for (std::uint32_t i = 0; i < splits; ++i) {
    if (counts[i] < least || counts[splits + i] < least) continue;
    const float right_cost = measures[splits + i] * leaf_cost(counts[splits + i], side_by_side);
    const float cost = measures[i] * leaf_cost(counts[i], side_by_side) + right_cost;
    if (cost < best.cost) best = {cost, axis, i + 1};
  }
}

SplitBoxes Bins::at(const Split& split) const {
  const auto axis = static_cast<std::size_t>(split.axis);
  SplitBoxes sides{0, Box4::empty(), Box4::empty()};
  for (std::uint32_t i = 0; i < split.bin; ++i) {
    sides.left.extend(boxes_[i][axis]);
    sides.left_count += counts_[i][axis];
  }
  for (std::uint32_t i = split.bin; i < used_; ++i) sides.right.extend(boxes_[i][axis]);
  return sides;
}

}  // namespace pah
