#include <algorithm>
#include <pah/accel/plan.hpp>

namespace pah {

// A derived area holds all that its rays may meet, mostly the whole scene. A world-space BVH over
// that makes a ray visit as many nodes as the global BVH does, whatever the heuristic, and its
// build takes time. A declared area can enclose its rays more tightly.
AreaPlan plan(const LocalArea& area) {
  if (area.declared) return {true, "declared"};
  return {false,
          "a local BVH in world space is not expected to beat the global one; declare the area to "
          "build it"};
}

namespace {

// The cost of a look-up, in the unit of build_config.hpp. It is fitted to this project's scenes,
// where it is off by a factor of at most two. A grid tests about the triangles that a BVH tests,
// but visits no nodes; tilted rays cross several cells.
double look_up_cost(const ExactBundle& rays, double bvh_cost) {
  const auto* parallel = std::get_if<ParallelBundle>(&rays);
  const bool tilted = parallel != nullptr && parallel->tangent > 0;
  return (tilted ? 7 : 3) + 0.3 * bvh_cost;
}

// The time to build a grid over the time to build the BVH. A cone of rays meets few triangles.
double build_cost(const ExactBundle& rays) {
  const auto* point = std::get_if<PointBundle>(&rays);
  return point != nullptr && point->sine < 1 ? 0.5 : 1.5;
}

constexpr std::uint64_t typical_bytes_per_triangle = 40;

double saving(const GridPilot& pilot, double seconds_per_ray, double build_seconds, int threads) {
  return pilot.expected_rays * (pilot.seconds - seconds_per_ray) / threads - build_seconds;
}

}  // namespace

GridPlan plan_grid(std::uint32_t bundle, const ExactBundle& rays, const GridPilot& pilot,
                   const GridCircumstances& at) {
  GridPlan plan;
  plan.bundle = bundle;
  plan.pilot = pilot;
  plan.predicted_bytes = typical_bytes_per_triangle * at.triangles;
  if (pilot.rays == 0 || !(pilot.cost > 0)) {
    plan.reason = "none of the pilot's rays goes to it";
    return plan;
  }
  plan.predicted_seconds = pilot.seconds * look_up_cost(rays, pilot.cost) / pilot.cost;
  plan.predicted_build_seconds = build_cost(rays) * at.bvh_build_seconds;
  plan.predicted_saving =
      saving(pilot, plan.predicted_seconds, plan.predicted_build_seconds, at.threads);
  if (plan.predicted_bytes > at.memory_left) {
    plan.reason = "it would take more memory than the scene allows";
  } else if (plan.predicted_seconds >= pilot.seconds) {
    plan.reason = "the BVH answers its rays at least as fast";
  } else if (plan.predicted_saving <= plan.predicted_build_seconds) {  // predictions are rough
    plan.reason = "too few rays are expected: it would cost more than it saves";
  } else {
    plan.build = true;
    plan.reason = "it is expected to save more than it costs";
  }
  return plan;
}

void measure_grid(GridPlan& plan, double seconds_per_ray, double build_seconds, std::uint64_t bytes,
                  const GridCircumstances& at) {
  const GridPilot pilot = plan.pilot.value_or(GridPilot{});
  plan.measured_seconds = seconds_per_ray;
  plan.measured_saving = saving(pilot, seconds_per_ray, build_seconds, at.threads);
  if (bytes > at.memory_left) {
    plan.build = false;
    plan.reason = "it took more memory than the scene allows";
  } else if (seconds_per_ray >= pilot.seconds) {
    plan.build = false;
    plan.reason = "the pilot's rays were no faster once it was built";
  }
}

}  // namespace pah
