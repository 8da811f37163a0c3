#include "accel/local/bundle_heuristic.hpp"

#include <algorithm>
#include <functional>
#include <pah/influence/bundle_area.hpp>
#include <pah/influence/facing.hpp>

namespace pah {
namespace {

// SPFH. An axis without extent cannot be split.
std::array<RatedAxis, 3> rate_axes(const InfluenceArea& area, const Aabb& box) {
  const DVec3 direction = mean_direction(area, box);
  const DVec3 quality = facing_quality(direction);
  std::array<RatedAxis, 3> rated;
  const std::array<int, 3> order = facing_axis_order(direction);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int k = order[i];
    rated[i] = {k, box.max[k] > box.min[k] ? quality[k] : -1};
  }
  std::ranges::stable_sort(rated, std::ranges::greater{}, &RatedAxis::quality);
  return rated;
}

}  // namespace

BuildHeuristic bundle_heuristic(const InfluenceArea& area, const LocalConfig& config) {
  BuildHeuristic heuristic = surface_area_heuristic();
  if (config.heuristic == Heuristic::projected_area) {
    heuristic.measure = each_box(HitProbability(area));
    heuristic.whole = 1;
    heuristic.square_meters = cross_section(area);
  }
  if (config.heuristic == Heuristic::mean_direction) {
    heuristic.measure = each_box(ParallelBundleArea(mean_absolute_direction(area)));
    heuristic.square_meters = 1;
  }
  if (config.split == SplitAxis::longest) heuristic.axes = longest_axis;
  if (config.split == SplitAxis::facing)
    heuristic.search = AxisSearch{[area](const Aabb& box) { return rate_axes(area, box); },
                                  config.facing.threshold, config.facing.excellent_ratio,
                                  config.facing.acceptable_ratio};
  if (config.non_fallback_levels != BuildHeuristic::never) {
    BuildHeuristic fallback = surface_area_heuristic();
    fallback.axes = longest_axis;
    heuristic.deeper = std::make_shared<const BuildHeuristic>(std::move(fallback));
    heuristic.deeper_from = config.non_fallback_levels;
  }
  return heuristic;
}

}  // namespace pah
