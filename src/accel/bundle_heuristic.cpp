#include "accel/bundle_heuristic.hpp"

#include <pah/influence/bundle_area.hpp>
#include <pah/influence/facing.hpp>

namespace pah {
namespace {

// The axes that SPFH admits for a node: those of enough facing quality, or else the best one.
AxisMask facing_axes(const InfluenceArea& area, double threshold, const Aabb& box) {
  const DVec3 direction = mean_direction(area, box);
  const DVec3 quality = facing_quality(direction);
  AxisMask mask = 0;
  for (int k = 0; k < 3; ++k) {
    if (quality[k] >= threshold && box.max[k] > box.min[k]) mask |= 1U << k;
  }
  return mask != 0 ? mask : 1U << facing_axis_order(direction).front();
}

}  // namespace

BuildHeuristic bundle_heuristic(const InfluenceArea& area, const LocalConfig& config) {
  BuildHeuristic heuristic = surface_area_heuristic();
  if (config.heuristic == Heuristic::projected_area)
    heuristic.measure = each_box(HitProbability(area));
  if (config.split == SplitAxis::longest) heuristic.axes = longest_axis;
  if (config.split == SplitAxis::facing)
    heuristic.axes = [area, threshold = config.facing_threshold](const Aabb& box) {
      return facing_axes(area, threshold, box);
    };
  return heuristic;
}

}  // namespace pah
