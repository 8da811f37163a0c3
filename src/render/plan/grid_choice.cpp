#include "render/plan/grid_choice.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <pah/bvh/build_config.hpp>

#include "base/parallel_for.hpp"
#include "base/stopwatch.hpp"
#include "render/bsdf/material_eval.hpp"
#include "render/plan/pilot.hpp"

namespace pah {
namespace {

// The minimum time per ray on one thread, over some rounds.
double seconds_a_ray(const Accelerator& accelerator, const std::vector<Ray>& rays) {
  constexpr int rounds = 3;
  std::vector<std::uint8_t> occluded(rays.size());
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const Stopwatch elapsed;
    accelerator.occluded(rays, occluded);
    least = std::min(least, elapsed.seconds());
  }
  return least / static_cast<double>(rays.size());
}

GridPilot measured(const Accelerator& bvh, const PilotRays& pilot) {
  GridPilot result{.expected_rays = pilot.expected, .rays = pilot.rays.size()};
  if (pilot.rays.empty()) return result;
  const auto rays = static_cast<double>(pilot.rays.size());
  std::vector<std::uint8_t> occluded(pilot.rays.size());
  TraversalCounts counts;
  bvh.occluded(pilot.rays, occluded, &counts);
  result.occluded_share = static_cast<double>(std::ranges::count(occluded, 1)) / rays;
  result.cost = traversal_cost(counts) / rays;
  result.seconds = seconds_a_ray(bvh, pilot.rays);
  return result;
}

std::vector<PilotLight> lights_with_bundles(const World& world) {
  std::vector<PilotLight> lights;
  for (std::size_t i = 0; i < world.lights.size(); ++i) {
    if (const auto rays = exact_bundle(world.lights[i]))
      lights.push_back({static_cast<LightId>(i), *rays});
  }
  return lights;
}

std::uint64_t memory_left(const Accelerator& accelerator, const AccelerationSettings& settings) {
  if (!settings.memory) return std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t taken = accelerator.memory().total();
  return *settings.memory - std::min(taken, *settings.memory);
}

// Marks a grid to be built whether it pays or not, if memory allows.
void ask_for(GridPlan& plan, std::uint64_t bytes, const GridCircumstances& at) {
  plan.build = bytes <= at.memory_left;
  plan.reason = plan.build ? "asked for" : "it takes more memory than the scene allows";
}

}  // namespace

std::string_view no_grids(const World& world, const Scene& settings) {
  constexpr std::size_t fewest_triangles = 4096;
  if (!settings.influence_areas.derive) return "the scene asks for no derived areas";
  if (world.triangles().size() < fewest_triangles)
    return "with so few triangles the BVH is as fast as a grid";
  if (settings.render.strategy == Strategy::bsdf) return "no shadow rays are sent";
  const auto lets_through = [&](const Surface& surface) {
    return is_masked(world.materials[surface.material]);
  };
  if (std::ranges::any_of(world.surfaces, lets_through))
    return "some surfaces are partly transparent, so shadow rays need nearest hits";
  return {};
}

std::vector<GridPlan> plans_without_grids(const World& world, std::string_view reason) {
  const std::vector<PilotLight> lights = lights_with_bundles(world);
  std::vector<GridPlan> plans(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    plans[i].bundle = lights[i].light;
    plans[i].reason = reason;
  }
  return plans;
}

std::vector<GridPlan> add_grids(LightGrids& grids, const World& world, const Scene& settings,
                                bool all) {
  GridCircumstances at{.triangles = world.triangles().size(),
                       .bvh_build_seconds = grids.bvh_build_seconds(),
                       .threads = static_cast<int>(parallel_threads())};
  const std::vector<PilotLight> lights = lights_with_bundles(world);
  const std::vector<PilotRays> pilots = pilot_rays(world, settings, grids, lights);
  std::vector<GridPlan> plans;
  plans.reserve(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i)
    plans.push_back(plan_grid(lights[i].light, lights[i].rays, measured(grids, pilots[i]), at));
  std::vector<std::size_t> order(lights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::size_t i) { return plans[i].predicted_saving; });
  for (const std::size_t i : order) {
    GridPlan& plan = plans[i];
    if (!plan.build && !all) continue;
    at.memory_left = memory_left(grids, settings.acceleration);
    plan = plan_grid(plan.bundle, lights[i].rays, plan.pilot.value_or(GridPilot{}), at);
    if (all) ask_for(plan, plan.predicted_bytes, at);
    if (!plan.build) continue;
    const std::uint64_t before = grids.memory().total();
    grids.add({plan.bundle, lights[i].rays});
    const std::uint64_t bytes = grids.memory().total() - before;
    const std::vector<LightGridReport> reports = grids.reports();
    const double build_seconds =
        std::ranges::find(reports, plan.bundle, &LightGridReport::bundle)->build_seconds;
    if (!pilots[i].rays.empty())
      measure_grid(plan, seconds_a_ray(grids, pilots[i].rays), build_seconds, bytes, at);
    if (all) ask_for(plan, bytes, at);
    if (!plan.build) grids.remove(plan.bundle);
  }
  return plans;
}

}  // namespace pah
