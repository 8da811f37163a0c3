// Experiment 3: one parameter of the build at a time, the others at their defaults.
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

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> all{
      {"bins",
       SplitAxis::best,
       16,
       {4, 8, 16, 32},
       [](LocalConfig& c, double v) { c.build.bins = static_cast<std::uint32_t>(v); }},
      {"max_leaf",
       SplitAxis::best,
       8,
       {1, 2, 4, 8},
       [](LocalConfig& c, double v) { c.build.max_leaf = static_cast<std::uint32_t>(v); }},
      {"facing_threshold", SplitAxis::facing, 0.5, {0.3, 0.5, 0.7}, [](LocalConfig& c, double v) {
         c.facing.threshold = v;
       }}};
  return all;
}

double cost_of(const StudySite& site, const LocalConfig& config) {
  const BinaryTree tree = build_local(site, config).tree;
  return count_closest(site.on(tree, config.build), site.rays).mean();
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
        SweepRow row;
        row.tree = site.named(config);
        row.parameter = parameter.name;
        row.value = value;
        row.cost = cost_of(site, config);
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
