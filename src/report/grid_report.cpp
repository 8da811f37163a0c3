#include "report/grid_report.hpp"

#include <algorithm>

namespace pah {
namespace {

// Only if there is a value to take it of.
template <typename Whole, typename Part>
std::optional<Part> part_of(const std::optional<Whole>& whole, Part Whole::*part) {
  return whole ? std::optional((*whole).*part) : std::nullopt;
}

// Nothing where no ray was traced.
std::optional<GridPilot> traced_pilot(const GridPlan& plan) {
  return plan.pilot && plan.pilot->rays > 0 ? plan.pilot : std::nullopt;
}

}  // namespace

std::vector<GridReport> report_grids(const Acceleration& acceleration, const World& world) {
  const std::vector<LightGridReport> built = acceleration.grids != nullptr
                                                 ? acceleration.grids->reports()
                                                 : std::vector<LightGridReport>{};
  std::vector<GridReport> reports;
  for (const GridPlan& plan : acceleration.grid_plans) {
    GridReport report{world.lights[plan.bundle].name, plan};
    const auto grid = std::ranges::find(built, plan.bundle, &LightGridReport::bundle);
    if (grid != built.end()) {
      report.build_seconds = grid->build_seconds;
      report.bytes = grid->bytes;
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

JsonValue grids_json(const std::vector<GridReport>& grids) {
  JsonValue json = JsonValue::array();
  for (const GridReport& grid : grids) {
    const GridPlan& plan = grid.plan;
    const std::optional<GridPilot> traced = traced_pilot(plan);
    const auto if_predicted = [&](double value) {
      return traced ? std::optional(value) : std::nullopt;
    };
    json.push_back({{"light", grid.light},
                    {"built", plan.build},
                    {"reason", plan.reason},
                    {"expected_rays", part_of(plan.pilot, &GridPilot::expected_rays)},
                    {"pilot_rays", part_of(plan.pilot, &GridPilot::rays)},
                    {"occluded_share", part_of(traced, &GridPilot::occluded_share)},
                    {"bvh_seconds_per_ray", part_of(traced, &GridPilot::seconds)},
                    {"bvh_cost_per_ray", part_of(traced, &GridPilot::cost)},
                    {"predicted_seconds_per_ray", if_predicted(plan.predicted_seconds)},
                    {"measured_seconds_per_ray", plan.measured_seconds},
                    {"predicted_build_seconds", if_predicted(plan.predicted_build_seconds)},
                    {"build_seconds", grid.build_seconds},
                    {"predicted_saved_seconds", if_predicted(plan.predicted_saving)},
                    {"saved_seconds", plan.measured_saving},
                    {"bytes", grid.bytes},
                    {"cells", part_of(grid.lists, &GridLists::cells)},
                    {"empty_cells", part_of(grid.lists, &GridLists::empty_cells)},
                    {"entries", part_of(grid.lists, &GridLists::entries)},
                    {"longest_list", part_of(grid.lists, &GridLists::longest_list)}});
  }
  return json;
}

}  // namespace pah
