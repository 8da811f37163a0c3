// Experiments 2 and 4: compares the trees of all heuristics and choices of axes by the cost of a
// bundle's rays, and by the share of rays that must hit in the area for it to pay: a ray costs
// local + (1 - share) * global instead of global.
#include <cmath>
#include <ctime>
#include <pah/bvh/analyze.hpp>

#include "report/study/local.hpp"

namespace pah {
namespace {

// Returns the CPU time of all threads, so that other programs do not count.
double cpu_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

}  // namespace

void study_cost(const StudySite& site, const BuiltBvh& global,
                std::span<const std::uint32_t> all_triangles, StudyResults& results) {
  const StudyTree global_tree{global.tree, site.mesh.triangles(), all_triangles,
                              BuildConfig{}.side_by_side};
  const double global_cost = count_closest(global_tree, site.rays, false).mean_of_all();
  for (const Heuristic heuristic :
       {Heuristic::surface_area, Heuristic::projected_area, Heuristic::mean_direction}) {
    for (const SplitAxis split : {SplitAxis::longest, SplitAxis::best, SplitAxis::facing}) {
      LocalConfig config;
      config.heuristic = heuristic;
      config.split = split;
      const double start = cpu_seconds();
      const BuiltBvh built = build_local(site, config);
      CostRow row;
      row.build_seconds = cpu_seconds() - start;
      row.tree = site.named(config);
      const Tally tally = count_closest(site.on(built.tree, config.build), site.rays);
      row.closest = tally.mean();
      row.all = count_all(site.on(built.tree, config.build), site.rays).mean();
      row.kernel = kernel_cost(built.bvh, site.rays, config.build.side_by_side);
      row.hit_share = tally.hit_share();
      const TreeSummary summary = summarize(built.tree, each_box(SurfaceArea{}));
      row.mean_depth = summary.leaves > 1
                           ? summary.mean_depth / std::log2(static_cast<double>(summary.leaves))
                           : 1;
      row.max_depth = summary.max_depth;
      row.lopsided = summary.balance.lopsided;
      row.break_even = global_cost > 0 ? tally.mean_of_all() / global_cost : 0;
      results.costs.push_back(row);
    }
  }
}

}  // namespace pah
