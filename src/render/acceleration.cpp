#include <algorithm>
#include <array>
#include <iterator>
#include <pah/render/acceleration.hpp>
#include <stdexcept>
#include <string>

namespace pah {
namespace {

constexpr std::array<AcceleratorName, 5> names{{
    {"bvh", "one BVH over all triangles"},
    {"local", "that, and a local BVH for each influence area"},
    {"light",
     "one BVH, and a grid in the space of each light that is\na point or has one direction"},
    {"brute_force", "no structure: every ray tests every triangle"},
    {"embree", "Embree's BVH, for comparison: the picture may differ\nin last bits"},
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

LocalConfig local_config(const AccelerationSettings& settings) {
  LocalConfig config;
  config.heuristic = settings.heuristic.value_or(config.heuristic);
  config.split = settings.split_axis;
  config.build.bins = static_cast<std::uint32_t>(settings.bins);
  config.build.max_leaf = static_cast<std::uint32_t>(settings.max_leaf_triangles);
  return config;
}

namespace {

// Of all shadow rays, by how often paths meet surfaces in scenes at hand, shared alike by lights.
double expected_rays_to_a_light(const World& world, const Scene& settings) {
  constexpr int surfaces_met = 2;
  const double samples =
      static_cast<double>(settings.film.width) * settings.film.height * settings.render.samples;
  return samples * std::min(settings.render.max_depth, surfaces_met) /
         static_cast<double>(std::max<std::size_t>(world.lights.size(), 1));
}

std::vector<GridPlan> grid_plans(const World& world, const Scene& settings) {
  const double rays = expected_rays_to_a_light(world, settings);
  std::vector<GridPlan> plans;
  for (std::size_t i = 0; i < world.lights.size(); ++i) {
    if (exact_bundle(world.lights[i]))
      plans.push_back(plan_grid(static_cast<std::uint32_t>(i), world.triangles().size(), rays));
  }
  return plans;
}

}  // namespace

Acceleration make_acceleration(const World& world, const Scene& settings, std::string_view name) {
  Acceleration made;
  made.areas = areas_of(world, settings.influence_areas, settings.film);
  for (const SceneArea& area : made.areas) made.plans.push_back(plan(local_area(area)));
  made.grid_plans = grid_plans(world, settings);
  const bool any = std::ranges::any_of(made.plans, &AreaPlan::build);
  const bool grids =
      settings.influence_areas.derive && std::ranges::any_of(made.grid_plans, &GridPlan::build);
  const std::string_view wanted = !name.empty() ? name : any ? local : grids ? light : bvh;
  const auto known = std::ranges::find(accelerator_names(), wanted, &AcceleratorName::name);
  if (known == accelerator_names().end())
    throw std::invalid_argument("unknown accelerator '" + std::string(wanted) + "'");
  made.name = known->name;
  if (made.name == local) {
    std::vector<LocalArea> areas;
    for (std::size_t i = 0; i < made.areas.size(); ++i)
      if (made.plans[i].build) areas.push_back(local_area(made.areas[i]));
    auto accelerator =
        make_local_bvhs(world.triangles(), areas, local_config(settings.acceleration));
    made.local = accelerator.get();
    made.accelerator = std::move(accelerator);
  }
  if (made.name == light) {
    std::vector<LightBundle> bundles;
    for (GridPlan& plan : made.grid_plans) {
      if (!name.empty()) plan = {plan.bundle, plan.expected_rays, true, "asked for"};
      const auto rays = exact_bundle(world.lights[plan.bundle]);
      if (plan.build && rays) bundles.push_back({plan.bundle, *rays});
    }
    auto accelerator = make_light_grids(world.triangles(), bundles);
    made.grids = accelerator.get();
    made.accelerator = std::move(accelerator);
  }
  if (made.local == nullptr) {
    for (AreaPlan& plan : made.plans)
      if (plan.build) plan = {false, "the accelerator asked for knows no areas"};
  }
  if (made.grids == nullptr) {
    for (GridPlan& plan : made.grid_plans)
      if (plan.build)
        plan = {plan.bundle, plan.expected_rays, false, "the accelerator knows no grids"};
  }
  if (made.accelerator != nullptr) return made;
  made.accelerator = made.name == bvh           ? make_global_bvh(world.triangles())
                     : made.name == brute_force ? make_brute_force(world.triangles())
                                                : make_embree(world.triangles());
  return made;
}

}  // namespace pah
