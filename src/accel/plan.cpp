#include <algorithm>
#include <pah/accel/plan.hpp>

namespace pah {

// Derived areas hold all that their rays may meet, mostly the whole scene. A BVH in world space
// over that puts as many nodes in a ray's way as the global one, whatever it is built by, and costs
// a build. (A declared area can be tight about what matters.) A structure in the bundle's own
// coordinates may change that, and then this is the place to say so.
AreaPlan plan(const LocalArea& area) {
  if (area.declared) return {true, "declared"};
  return {false,
          "a local BVH in world space is not expected to beat the global one; declare the area to "
          "build it"};
}

namespace {

// Of a look-up, in the unit of build_config.hpp: fitted to the scenes of this project, where it is
// off by up to a factor of two. What is tested in a BVH is so in a grid, too, nodes apart; ways of
// leaning rays cross some cells.
double look_up_cost(const ExactBundle& rays, double bvh_cost) {
  const auto* parallel = std::get_if<ParallelBundle>(&rays);
  const bool lean = parallel != nullptr && parallel->tangent > 0;
  return (lean ? 7 : 3) + 0.3 * bvh_cost;
}

// In times that of the BVH. A cone of rays meets few of the triangles.
double build_cost(const ExactBundle& rays) {
  const auto* point = std::get_if<PointBundle>(&rays);
  return point != nullptr && point->sine < 1 ? 0.5 : 1.5;
}

constexpr std::uint64_t usual_bytes_a_triangle = 40;

double saving(const GridPilot& pilot, double seconds_a_ray, double build_seconds, int threads) {
  return pilot.expected_rays * (pilot.seconds - seconds_a_ray) / threads - build_seconds;
}

}  // namespace

GridPlan plan_grid(std::uint32_t bundle, const ExactBundle& rays, const GridPilot& pilot,
                   const GridCircumstances& at) {
  GridPlan plan;
  plan.bundle = bundle;
  plan.pilot = pilot;
  plan.predicted_bytes = usual_bytes_a_triangle * at.triangles;
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
  } else if (plan.predicted_saving <= plan.predicted_build_seconds) {  // predictions being rough
    plan.reason = "too few rays are expected: it would cost more than it saves";
  } else {
    plan.build = true;
    plan.reason = "it is expected to save more than it costs";
  }
  return plan;
}

void measure_grid(GridPlan& plan, double seconds_a_ray, double build_seconds, std::uint64_t bytes,
                  const GridCircumstances& at) {
  const GridPilot pilot = plan.pilot.value_or(GridPilot{});
  plan.measured_seconds = seconds_a_ray;
  plan.measured_saving = saving(pilot, seconds_a_ray, build_seconds, at.threads);
  if (bytes > at.memory_left) {
    plan.build = false;
    plan.reason = "it took more memory than the scene allows";
  } else if (seconds_a_ray >= pilot.seconds) {
    plan.build = false;
    plan.reason = "the pilot's rays were no faster once it was built";
  }
}

}  // namespace pah
