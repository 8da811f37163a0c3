// What the builder asks of a heuristic.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <pah/bvh/box_measure.hpp>

namespace pah {

struct RatedAxis {
  int axis = 0;
  double quality = 0;  // in [0, 1]; large is good
};

// Which axes of a node are tried, one after the other (thesis, algorithm 5.1). What a split is like
// tells the sum of the chances of its halves to be hit, over the node's: less than 1 if no ray
// meets both, up to 2 if all do.
struct AxisSearch {
  std::function<std::array<RatedAxis, 3>(const Aabb&)> rate;  // the best first
  double threshold = 0;                                       // axes of less quality are not tried
  double excellent = 0;   // a split of at most that ratio ends the search
  double acceptable = 2;  // if axes are left, but none good enough: one of at most that does, and
                          // without one the longest axis is tried
};

struct BuildHeuristic {
  static constexpr std::uint32_t never = 0xFFFFFFFFU;

  BoxMeasure measure;
  std::function<AxisMask(const Aabb&)> axes;  // that may be split, of a node
  std::optional<AxisSearch> search{};         // in place of `axes`
  // What decides from a depth on.
  std::shared_ptr<const BuildHeuristic> deeper{};
  std::uint32_t deeper_from = never;
  double whole = 0;          // the measure of what all rays hit; 0: the root's box
  double square_meters = 2;  // of a measure of 1

  // The builder knows this measure itself.
  [[nodiscard]] bool by_area() const { return measure.target<EachBox<SurfaceArea>>() != nullptr; }
};

[[nodiscard]] inline AxisMask any_axis(const Aabb& /*box*/) { return all_axes; }
[[nodiscard]] AxisMask longest_axis(const Aabb& box);

// SAH: as if rays came from everywhere.
[[nodiscard]] inline BuildHeuristic surface_area_heuristic() {
  return {each_box(SurfaceArea{}), any_axis};
}

}  // namespace pah
