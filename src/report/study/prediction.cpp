// Experiment 1: compares the predicted cost of a ray with the counted one.
#include <pah/bvh/analyze.hpp>
#include <pah/influence/bundle_area.hpp>

#include "report/study/local.hpp"

namespace pah {
namespace {

double expected_by(const InfluenceArea& area, const BinaryTree& tree, const BuildConfig& config) {
  return expected_cost(tree, config, each_box(HitProbability(area)));
}

// The cost for a bundle without borders: all parallel rays, or all rays of half a sphere.
double expected_unclipped(const InfluenceArea& area, const BinaryTree& tree,
                          const BuildConfig& config) {
  if (const auto* plane = std::get_if<PlaneArea>(&area))
    return expected_cost(tree, config, each_box(ParallelBundleArea(glm::abs(plane->box.axes[2]))));
  PointArea wide = std::get<PointArea>(area);
  // This pyramid misses a thousandth of the half sphere.
  wide.frustum.tan_half = DVec2(1e3);
  wide.frustum.near = 0;
  wide.frustum.far *= 1e3;
  wide.measure = PointMeasure::solid_angle;
  return expected_by(wide, tree, config);
}

double expected_in_plane(InfluenceArea area, const BinaryTree& tree, const BuildConfig& config) {
  if (auto* point = std::get_if<PointArea>(&area)) point->measure = PointMeasure::plane;
  return expected_by(area, tree, config);
}

}  // namespace

void study_prediction(const StudySite& site, StudyResults& results) {
  for (const Heuristic heuristic : {Heuristic::surface_area, Heuristic::projected_area}) {
    LocalConfig config;
    config.heuristic = heuristic;
    const BinaryTree tree = build_local(site, config).tree;
    const StudyTree on = site.on(tree, config.build);
    const Tally all = count_all(on, site.rays);
    const InfluenceArea& area = site.area.area;
    PredictionRow row;
    row.tree = site.named(config);
    row.measured = all.mean();
    row.standard_error = all.standard_error();
    row.closest = count_closest(on, site.rays).mean();
    row.pah = expected_by(area, tree, config.build);
    row.pah_plane = expected_in_plane(area, tree, config.build);
    row.pah_unclipped = expected_unclipped(area, tree, config.build);
    row.sah = expected_cost(tree, config.build, each_box(SurfaceArea{}));
    results.predictions.push_back(row);
  }
}

}  // namespace pah
