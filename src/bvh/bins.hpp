// Items sorted into bins, and the cheapest split between bins.
#pragma once

#include <array>
#include <span>

#include "bvh/heuristic.hpp"
#include "bvh/item.hpp"

namespace pah {

struct Split {
  float cost = std::numeric_limits<float>::infinity();
  int axis = 0;
  std::uint32_t bin = 0;  // the first bin of the right side; 0 if there is no split
};

// Tells on which side of a split an item is.
struct Side {
  int axis;
  float origin, scale, border;

  // NaN is on the right, as Binning puts it in the last bin.
  [[nodiscard, gnu::always_inline]] bool is_right(const Item& item) const {
    const float centroid = 0.5F * item.box.min[axis] + 0.5F * item.box.max[axis];
    return !((centroid - origin) * scale < border);
  }
};

// Maps centroids to bins on all axes at once. An axis without extent has scale 0: it cannot be
// split.
class Binning {
 public:
  Binning(const Box4& centroids, std::uint32_t bins, AxisMask axes);

  [[nodiscard]] std::uint32_t bins() const { return bins_; }
  [[nodiscard]] bool splits(int axis) const { return scale_[axis] > 0; }
  [[nodiscard, gnu::always_inline]] Int4 bins_of(const Item& item) const {
    // min() puts NaN, which overflows cause, in the last bin.
    const Float4 position = (item.centroid() - origin_) * scale_;
    return __builtin_convertvector(min(position, last_), Int4);
  }
  [[nodiscard]] Side side_of(const Split& split) const {
    return {split.axis, origin_[split.axis], scale_[split.axis], static_cast<float>(split.bin)};
  }

 private:
  Float4 origin_, scale_, last_;
  std::uint32_t bins_;
};

struct SplitBoxes {
  std::uint32_t left_count;
  Box4 left, right;
};

class Bins {
 public:
  // Clears only the bins in use: small nodes have few.
  explicit Bins(std::uint32_t bins) { clear(bins); }

  void add(std::span<const Item> items, const Binning& binning);
  void add(const Bins& other);

  // The cheapest split by surface area, or by any measure. Ties go to the first axis, then to the
  // first bin. No side has fewer than `least` items.
  [[nodiscard]] Split cheapest_by_area(const Binning& binning, std::uint32_t side_by_side) const;
  [[nodiscard]] Split cheapest(const Binning& binning, const BoxMeasure& measure,
                               std::uint32_t side_by_side, std::uint32_t least = 1) const;
  [[nodiscard]] SplitBoxes at(const Split& split) const;

 private:
  void add(const Item& item, const Binning& binning);
  [[nodiscard]] Int4 counts_of(std::uint32_t bin) const {
    return std::bit_cast<Int4>(counts_[bin]);
  }
  void clear(std::uint32_t bins);
  void sweep(int axis, const BoxMeasure& measure, std::uint32_t side_by_side, std::uint32_t least,
             Split& best) const;

  static constexpr std::size_t axes = 3;
  std::uint32_t used_;
  std::array<std::array<Box4, axes>, BuildConfig::max_bins> boxes_;
  std::array<std::array<std::uint32_t, 4>, BuildConfig::max_bins> counts_;  // by axis
};

}  // namespace pah
