// Chooses how to split a node's items and partitions them.
#pragma once

#include <optional>
#include <span>

#include "bvh/bins.hpp"

namespace pah {

// A run of items, and as much room to move them to.
struct ItemRange {
  Item* items;
  Item* room;
  std::uint32_t first;  // position in the tree's order
  std::uint32_t count;

  [[nodiscard]] std::span<Item> span() const { return {items, count}; }
  [[nodiscard]] ItemRange part(std::uint32_t from, std::uint32_t size) const {
    return {items + from, room + from, first + from, size};
  }
  [[nodiscard]] ItemRange moved() const { return {room, items, first, count}; }
};

// The two sides of a split range.
struct Halves {
  ItemRange left, right;
  Box4 left_box, right_box;
};

[[nodiscard]] Box4 box_of(std::span<const Item> items);

class Splitter {
 public:
  // The root's box gives the measure of all rays where the heuristic does not set it.
  Splitter(const BuildConfig& config, const BuildHeuristic& heuristic, const Box4& root);

  // Partitions the range in two; nothing if it becomes a leaf.
  [[nodiscard]] std::optional<Halves> split(const ItemRange& range, const Box4& box,
                                            std::uint32_t depth) const;

 private:
  struct BinnedSplit;

  [[nodiscard]] bool is_leaf_by_rule(std::uint32_t count, const Box4& box) const;
  [[nodiscard]] BinnedSplit cheapest(const ItemRange& range, const Box4& centroids, AxisMask axes,
                                     const BuildHeuristic& heuristic) const;
  [[nodiscard]] BinnedSplit search(const ItemRange& range, const Box4& box, const Box4& centroids,
                                   const BuildHeuristic& heuristic, const AxisSearch& rules) const;

  std::uint32_t bins_;
  std::uint32_t max_leaf_;
  std::uint32_t side_by_side_;
  double least_share_;
  LeafRules leaves_;
  std::uint32_t last_level_;
  const BuildHeuristic& heuristic_;
  double whole_ = 0;  // the measure of all rays, if a leaf rule needs it
};

}  // namespace pah
