#include "cli/accelerators.hpp"

#include <algorithm>
#include <array>

namespace pah::cli {
namespace {

constexpr std::array<AcceleratorName, 3> names{{
    {"bvh", "one BVH over all triangles"},
    {"local", "that, and a local BVH for each influence area"},
    {"brute_force", "no structure: every ray tests every triangle"},
}};
constexpr std::string_view bvh = names[0].name;
constexpr std::string_view local = names[1].name;

std::unique_ptr<LocalBvhs> make_local(const ChosenAccelerator& chosen, const World& world,
                                      const AccelerationSettings& settings) {
  std::vector<LocalArea> areas;
  for (std::size_t i = 0; i < chosen.areas.size(); ++i)
    if (chosen.choices[i].build) areas.push_back({chosen.areas[i].area, chosen.areas[i].bundle});
  return make_local_bvhs(world.triangles(), areas, local_config(settings));
}

}  // namespace

LocalConfig local_config(const AccelerationSettings& settings) {
  LocalConfig config;
  if (settings.heuristic == Heuristic::pah) config.heuristic = LocalHeuristic::projected_area;
  if (settings.split_axis == SplitAxis::longest) config.split = LocalSplit::longest;
  if (settings.split_axis == SplitAxis::facing) config.split = LocalSplit::facing;
  config.build.bins = static_cast<std::uint32_t>(settings.bins);
  config.build.max_leaf = static_cast<std::uint32_t>(settings.max_leaf_triangles);
  return config;
}

std::span<const AcceleratorName> accelerators() { return names; }

bool is_accelerator(std::string_view name) {
  return std::ranges::find(names, name, &AcceleratorName::name) != names.end();
}

ChosenAccelerator make_accelerator(std::string_view name, const World& world,
                                   const Scene& settings) {
  ChosenAccelerator chosen;
  chosen.areas = areas_of(world, settings.influence_areas, settings.film);
  std::ranges::transform(chosen.areas, std::back_inserter(chosen.choices), choose);
  const bool any = std::ranges::any_of(chosen.choices, &AreaChoice::build);
  chosen.name = !name.empty() ? name : any ? local : bvh;
  if (chosen.name == local) {
    auto accelerator = make_local(chosen, world, settings.acceleration);
    chosen.local = accelerator.get();
    chosen.accelerator = std::move(accelerator);
    return chosen;
  }
  for (AreaChoice& choice : chosen.choices)
    if (choice.build) choice = {false, "the accelerator asked for knows no areas"};
  chosen.accelerator =
      chosen.name == bvh ? make_global_bvh(world.triangles()) : make_brute_force(world.triangles());
  return chosen;
}

std::vector<AreaReport> report_areas(const ChosenAccelerator& chosen) {
  std::vector<AreaReport> reports;
  const std::vector<LocalBvhUse> uses =
      chosen.local != nullptr ? chosen.local->uses() : std::vector<LocalBvhUse>{};
  std::size_t built = 0;
  for (std::size_t i = 0; i < chosen.areas.size(); ++i) {
    const SceneArea& area = chosen.areas[i];
    const AreaChoice& choice = chosen.choices[i];
    AreaReport report;
    report.name = area.name;
    report.type = type_name(area.area);
    report.light = area.light;
    report.built = choice.build;
    report.reason = choice.reason;
    if (choice.build) {
      const LocalBvhReport& bvh_report = chosen.local->reports()[built];
      const LocalBvhUse& use = uses[built];
      ++built;
      report.triangles = bvh_report.triangles;
      report.predicted_cost = bvh_report.predicted_cost;
      report.global_cost = bvh_report.global_cost;
      report.rays = use.answered;
      if (use.asked > 0) report.measured_cost = use.cost / static_cast<double>(use.asked);
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace pah::cli
