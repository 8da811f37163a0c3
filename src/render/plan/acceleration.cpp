#include <algorithm>
#include <array>
#include <iterator>
#include <pah/render/acceleration.hpp>
#include <stdexcept>
#include <string>

#include "render/plan/grid_choice.hpp"

namespace pah {
namespace {

constexpr std::array<AcceleratorName, 5> names{{
    {"bvh", "one BVH over all triangles"},
    {"local", "bvh, and a local BVH for each influence area"},
    {"light", "bvh, and a grid for each light that is a point or has\none direction"},
    {"brute_force", "no structure: every ray tests every triangle"},
    {"embree", "Embree's BVH, for comparison: the picture may differ\nin the last bits"},
}};
constexpr std::string_view bvh = names[0].name;
constexpr std::string_view local = names[1].name;
constexpr std::string_view light = names[2].name;
constexpr std::string_view brute_force = names[3].name;

}  // namespace

std::span<const AcceleratorName> accelerator_names() {
  return std::span(names).first(has_embree() ? names.size() : names.size() - 1);
}

LocalArea local_area(const SceneArea& area) { return {area.area, area.bundle, area.declared}; }

namespace {

void build_areas(Acceleration& made, const World& world, const LocalConfig& config) {
  std::vector<LocalArea> areas;
  for (AreaStatus& status : made.areas) {
    status.built = std::nullopt;
    if (!status.plan.build) continue;
    status.built = areas.size();
    areas.push_back(local_area(status.area));
  }
  auto accelerator = make_local_bvhs(world.triangles(), areas, config);
  made.local = accelerator.get();
  made.accelerator = std::move(accelerator);
}

void use_areas(Acceleration& made, const World& world, const AccelerationSettings& settings) {
  build_areas(made, world, settings.local);
  const AcceleratorMemory memory = made.accelerator->memory();
  if (!settings.memory || memory.total() <= *settings.memory) return;
  // Builds again, in order, the areas for which there is room.
  const std::vector<LocalBvhReport> reports = made.local->reports();
  const std::uint64_t overhead = memory.top_level / std::max<std::size_t>(reports.size(), 1);
  std::uint64_t total = memory.global_bvh;
  for (AreaStatus& status : made.areas) {
    if (!status.built) continue;
    const std::uint64_t bytes = reports[*status.built].bytes + overhead;
    if (total + bytes > *settings.memory) {
      status.plan = {false, "it would take more memory than the scene allows"};
    } else {
      total += bytes;
    }
  }
  build_areas(made, world, settings.local);
}

void use_grids(Acceleration& made, const World& world, const Scene& settings, bool all) {
  auto grids = make_light_grids(world.triangles());
  made.grid_plans = add_grids(*grids, world, settings, all);
  made.grids = grids.get();
  made.accelerator = std::move(grids);
}

}  // namespace

Acceleration make_acceleration(const World& world, const Scene& settings, std::string_view name) {
  Acceleration made;
  for (const SceneArea& area : areas_of(world, settings.influence_areas, settings.film))
    made.areas.push_back({area, plan(local_area(area))});
  const bool any =
      std::ranges::any_of(made.areas, [](const AreaStatus& status) { return status.plan.build; });
  const std::string_view why_none = no_grids(world, settings);
  const std::string_view wanted = !name.empty()      ? name
                                  : any              ? local
                                  : why_none.empty() ? light
                                                     : bvh;
  const auto known = std::ranges::find(accelerator_names(), wanted, &AcceleratorName::name);
  if (known == accelerator_names().end())
    throw std::invalid_argument("unknown accelerator '" + std::string(wanted) + "'");
  made.name = known->name;
  if (made.name == local) {
    use_areas(made, world, settings.acceleration);
  } else {
    for (AreaStatus& status : made.areas)
      if (status.plan.build)
        status.plan = {false, "the chosen accelerator does not use influence areas"};
  }
  if (made.name == light) {
    use_grids(made, world, settings, !name.empty());
    // Without a grid the accelerator is a plain BVH.
    if (name.empty() && made.grids->reports().empty()) made.name = bvh;
  } else {
    made.grid_plans = plans_without_grids(
        world, why_none.empty() ? "the chosen accelerator does not use grids" : why_none);
  }
  if (made.accelerator != nullptr) return made;
  made.accelerator = made.name == bvh           ? make_global_bvh(world.triangles())
                     : made.name == brute_force ? make_brute_force(world.triangles())
                                                : make_embree(world.triangles());
  return made;
}

}  // namespace pah
