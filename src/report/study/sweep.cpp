// Experiment 3: varies one build parameter at a time, with defaults for the others. Leaf rules are
// swept with large leaves, because cost alone decides for small nodes. The rule by surface area is
// left out: it equals the rule by chance, times a factor of the mesh.
#include <limits>
#include <pah/bvh/analyze.hpp>

#include "report/study/local.hpp"

namespace pah {
namespace {

struct Parameter {
  const char* name;
  SplitAxis split;
  double default_value;
  std::vector<double> values;
  void (*set)(LocalConfig&, double);
};

constexpr double never = std::numeric_limits<double>::infinity();

std::uint32_t whole(double value) { return static_cast<std::uint32_t>(value); }

LeafRules& of_large_leaves(LocalConfig& config) {
  config.build.max_leaf = BuildConfig::most_leaf;
  return config.build.leaves;
}

const std::vector<Parameter>& parameters() {
  using Config = LocalConfig;
  static const std::vector<Parameter> all{
      {"bins",
       SplitAxis::best,
       16,
       {4, 8, 16, 32},
       [](Config& c, double v) { c.build.bins = whole(v); }},
      {"max_leaf",
       SplitAxis::best,
       8,
       {1, 2, 4, 8},
       [](Config& c, double v) { c.build.max_leaf = whole(v); }},
      {"min_inner_triangles",
       SplitAxis::best,
       0,
       {0, 8, 16, 32},
       [](Config& c, double v) { of_large_leaves(c).triangles = whole(v); }},
      {"max_leaf_cost",
       SplitAxis::best,
       0,
       {0, 1e-4, 1e-3, 1e-2},
       [](Config& c, double v) { of_large_leaves(c).cost = v; }},
      {"max_leaf_probability",
       SplitAxis::best,
       0,
       {0, 1e-4, 1e-3, 1e-2},
       [](Config& c, double v) { of_large_leaves(c).probability = v; }},
      {"max_levels",
       SplitAxis::best,
       0,
       {0, 12, 15, 18},
       [](Config& c, double v) { c.build.leaves.levels = whole(v); }},
      {"non_fallback_levels",
       SplitAxis::best,
       never,
       {0, 4, 8, 12, never},
       [](Config& c, double v) {
         if (v < never) c.non_fallback_levels = whole(v);
       }},
      {"facing_threshold",
       SplitAxis::facing,
       0.5,
       {0.3, 0.5, 0.7},
       [](Config& c, double v) { c.facing.threshold = v; }},
      {"acceptable_ratio",
       SplitAxis::facing,
       2,
       {1, 1.25, 1.5, 2},
       [](Config& c, double v) { c.facing.acceptable_ratio = v; }},
      {"excellent_ratio",
       SplitAxis::facing,
       0,
       {0, 1, 1.25, 1.5},
       [](Config& c, double v) { c.facing.excellent_ratio = v; }},
      {"least_share",
       SplitAxis::longest,
       0,
       {0, 1.0 / 32, 1.0 / 16, 1.0 / 8, 1.0 / 4},
       [](Config& c, double v) { c.build.least_share = v; }}};
  return all;
}

SweepRow measure(const StudySite& site, const LocalConfig& config) {
  const BinaryTree tree = build_local(site, config).tree;
  SweepRow row;
  row.tree = site.named(config);
  row.cost = count_closest(site.on(tree, config.build), site.rays).mean();
  row.lopsided = balance_of(tree).lopsided;
  return row;
}

}  // namespace

void study_sweep(const StudySite& site, StudyResults& results) {
  for (const Heuristic heuristic : {Heuristic::surface_area, Heuristic::projected_area}) {
    for (const Parameter& parameter : parameters()) {
      double default_cost = 0;
      const std::size_t first = results.sweeps.size();
      for (const double value : parameter.values) {
        LocalConfig config;
        config.heuristic = heuristic;
        config.split = parameter.split;
        parameter.set(config, value);
        SweepRow row = measure(site, config);
        row.parameter = parameter.name;
        row.value = value;
        if (value == parameter.default_value) default_cost = row.cost;
        results.sweeps.push_back(row);
      }
      for (std::size_t i = first; i < results.sweeps.size(); ++i) {
        SweepRow& row = results.sweeps[i];
        row.over_default = default_cost > 0 ? row.cost / default_cost : 0;
      }
    }
  }
}

}  // namespace pah
