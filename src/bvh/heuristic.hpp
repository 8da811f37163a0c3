// The heuristics that guide the builder.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <pah/bvh/box_measure.hpp>

namespace pah {

struct RatedAxis {
  int axis = 0;
  double quality = 0;  // in [0, 1]; larger is better
};

// Tries the axes of a node one after the other (thesis, algorithm 5.1). The ratio of a split is the
// sum of its halves' hit probabilities over the node's: at most 1 if no ray meets both halves, up
// to 2 if all rays do.
struct AxisSearch {
  std::function<std::array<RatedAxis, 3>(const Aabb&)> rate;  // the best axis first
  double threshold = 0;                                       // axes of lower quality are not tried
  double excellent = 0;  // a split of at most this ratio ends the search
  double acceptable =
      2;  // the longest axis is tried, too, if no split so far has at most this ratio
};

struct BuildHeuristic {
  static constexpr std::uint32_t never = 0xFFFFFFFFU;

  BoxMeasure measure;
  std::function<AxisMask(const Aabb&)> axes;  // the axes of a node that may be split
  std::optional<AxisSearch> search{};         // replaces `axes`
  // Replaces this heuristic from a depth on.
  std::shared_ptr<const BuildHeuristic> deeper{};
  std::uint32_t deeper_from = never;
  double whole = 0;          // the measure of all rays; 0: the measure of the root's box
  double square_meters = 2;  // per unit of the measure

  // Whether the measure is the surface area, for which the builder has a faster sweep.
  [[nodiscard]] bool by_area() const { return measure.target<EachBox<SurfaceArea>>() != nullptr; }
};

[[nodiscard]] inline AxisMask any_axis(const Aabb& /*box*/) { return all_axes; }
[[nodiscard]] AxisMask longest_axis(const Aabb& box);

// SAH: assumes that rays come from everywhere.
[[nodiscard]] inline BuildHeuristic surface_area_heuristic() {
  return {each_box(SurfaceArea{}), any_axis};
}

}  // namespace pah
