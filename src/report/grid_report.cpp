#include "report/grid_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/format_bytes.hpp"

namespace pah {
namespace {

// A member of a value; null where there is no value.
template <typename Whole, typename Part>
OrderedJson part_of(const std::optional<Whole>& whole, Part Whole::*part) {
  return whole ? OrderedJson((*whole).*part) : OrderedJson();
}

// Returns nothing if the pilot traced no ray.
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
      report.lists = grid->lists;
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

namespace {

OrderedJson grid_json(const GridReport& grid) {
  const GridPlan& plan = grid.plan;
  const std::optional<GridPilot> traced = traced_pilot(plan);
  const auto if_predicted = [&](double value) {
    return traced ? OrderedJson(value) : OrderedJson();
  };
  return {{"light", grid.light},
          {"built", plan.build},
          {"reason", plan.reason},
          {"expected_rays", part_of(plan.pilot, &GridPilot::expected_rays)},
          {"pilot_rays", part_of(plan.pilot, &GridPilot::rays)},
          {"occluded_share", part_of(traced, &GridPilot::occluded_share)},
          {"bvh_seconds_per_ray", part_of(traced, &GridPilot::seconds)},
          {"bvh_cost_per_ray", part_of(traced, &GridPilot::cost)},
          {"predicted_seconds_per_ray", if_predicted(plan.predicted_seconds)},
          {"measured_seconds_per_ray", json_or_null(plan.measured_seconds)},
          {"predicted_build_seconds", if_predicted(plan.predicted_build_seconds)},
          {"build_seconds", json_or_null(grid.build_seconds)},
          {"predicted_saved_seconds", if_predicted(plan.predicted_saving)},
          {"saved_seconds", json_or_null(plan.measured_saving)},
          {"bytes", json_or_null(grid.bytes)},
          {"cells", part_of(grid.lists, &GridLists::cells)},
          {"empty_cells", part_of(grid.lists, &GridLists::empty_cells)},
          {"entries", part_of(grid.lists, &GridLists::entries)},
          {"longest_list", part_of(grid.lists, &GridLists::longest_list)}};
}

std::string line(std::string_view name, const std::string& value) {
  return fmt::format("  {:18}{}\n", name, value);
}

std::string seconds(double value) { return fmt::format("{:.3g} s", value); }

// The time of one thread.
std::string nanoseconds(double value) { return fmt::format("{:.1f} ns", 1e9 * value); }

template <typename Format>
std::string predicted_and_measured(double predicted, const std::optional<double>& measured,
                                   Format&& format) {
  std::string text = format(predicted) + " predicted";
  if (measured) text += ", " + format(*measured) + " measured";
  return text;
}

std::string pilot_text(const GridPlan& plan, const GridPilot& pilot) {
  return line("expected rays", fmt::format("{:.0f}", pilot.expected_rays)) +
         line("pilot rays", fmt::format("{}, of which {:.1f} % are occluded", pilot.rays,
                                        100 * pilot.occluded_share)) +
         line("per ray, BVH", nanoseconds(pilot.seconds) + " measured") +
         line("per ray, grid",
              predicted_and_measured(plan.predicted_seconds, plan.measured_seconds, nanoseconds)) +
         line("time saved",
              predicted_and_measured(plan.predicted_saving, plan.measured_saving, seconds));
}

std::string lists_text(const GridLists& lists) {
  const double empty =
      lists.cells == 0 ? 0
                       : static_cast<double>(lists.empty_cells) / static_cast<double>(lists.cells);
  return line("cells", fmt::format("{}, of which {:.1f} % are empty", lists.cells, 100 * empty)) +
         line("entries", fmt::format("{}, at most {} a cell", lists.entries, lists.longest_list));
}

}  // namespace

OrderedJson grids_json(const std::vector<GridReport>& grids) {
  OrderedJson json = OrderedJson::array();
  for (const GridReport& grid : grids) json.push_back(grid_json(grid));
  return json;
}

std::string grid_text(const GridReport& grid) {
  const GridPlan& plan = grid.plan;
  std::string text =
      fmt::format("\nGrid of light {}: {}\n", grid.light, plan.build ? "built" : "not built");
  text += line("reason", std::string(plan.reason));
  if (const auto pilot = traced_pilot(plan)) text += pilot_text(plan, *pilot);
  if (grid.lists) text += lists_text(*grid.lists);
  if (grid.bytes) text += line("memory", format_bytes(*grid.bytes));
  if (grid.build_seconds) text += line("build time", seconds(*grid.build_seconds));
  return text;
}

}  // namespace pah
