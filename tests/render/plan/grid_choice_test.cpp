// Tests which lights get grids, and for which reasons.
#include "render/plan/grid_choice.hpp"

#include <algorithm>
#include <pah/render/acceleration.hpp>
#include <pah/scene/shapes.hpp>

#include "catch.hpp"

using namespace pah;

namespace {

constexpr std::string_view would_be_too_large = "it would take more memory than the scene allows";
constexpr std::string_view is_too_large = "it took more memory than the scene allows";

const ExactBundle point = PointBundle{};

// The pilot of rays that cost a tenth in a grid.
constexpr GridPilot pilot{.expected_rays = 1e6, .rays = 100, .seconds = 1e-5, .cost = 40};

// A ball under a bulb and a lamp.
Scene lit_ball() {
  Scene scene;
  PerspectiveCamera camera;
  camera.position = {0, 1, 3};
  scene.camera = camera;
  scene.film.width = 64;
  scene.film.height = 64;
  scene.render.samples = 1 << 20;
  scene.materials.push_back({"gray", DiffuseMaterial{}});
  scene.meshes = {make_mesh(SphereShape{.segments = 128, .rings = 64})};
  scene.instances.emplace_back();
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 4, 0), Vec3(10)}});
  scene.lights.push_back({"lamp", SpotLight{DVec3(3, 3, 3), DVec3(-1, -1, -1)}});
  return scene;
}

std::uint64_t bytes_of_bvh(const World& world) {
  return make_global_bvh(world.triangles())->memory().global_bvh;
}

// Checks that no light of the scene gets a grid, for this reason.
void check_reason(const Scene& scene, std::string_view reason) {
  const World world = make_world(scene);
  CHECK(no_grids(world, scene) == reason);
  const Acceleration acceleration = make_acceleration(world, scene);
  CHECK(acceleration.name == "bvh");
  CHECK(acceleration.grid_plans.size() == 2);
  for (const GridPlan& plan : acceleration.grid_plans) {
    CHECK(!plan.build);
    CHECK(plan.reason == reason);
    CHECK(!plan.pilot);
  }
}

}  // namespace

TEST_CASE("A grid is built where it is expected to save more than it costs") {
  const GridCircumstances at{.triangles = 1000, .bvh_build_seconds = 2};
  const GridPlan plan = plan_grid(5, point, pilot, at);
  CHECK(plan.build);
  CHECK(plan.reason == "it is expected to save more than it costs");
  CHECK(plan.bundle == 5);
  CHECK(plan.predicted_seconds == Approx(3.75e-6));
  CHECK(plan.predicted_build_seconds == Approx(3));
  CHECK(plan.predicted_bytes == 40'000);
  CHECK(plan.predicted_saving == Approx(1e6 * 6.25e-6 - 3));
}

TEST_CASE("A grid is not built without rays") {
  const GridPlan plan = plan_grid(0, point, {}, {.triangles = 1000});
  CHECK(!plan.build);
  CHECK(plan.reason == "none of the pilot's rays goes to it");
}

TEST_CASE("A grid is not built if its rays are cheap in the BVH") {
  GridPilot cheap = pilot;
  cheap.cost = 3.9;
  CHECK(plan_grid(0, point, cheap, {}).reason == "the BVH answers its rays at least as fast");
  CHECK(!plan_grid(0, point, cheap, {}).build);
  // Rays to a sun with a size cross cells, and those to a spot come from a part of the scene.
  const ExactBundle spot = PointBundle{.sine = 0.5F};
  const ExactBundle sharp = ParallelBundle{}, soft = ParallelBundle{.tangent = 0.01F};
  const GridCircumstances at{.bvh_build_seconds = 1};
  CHECK(plan_grid(0, soft, pilot, at).predicted_seconds >
        plan_grid(0, sharp, pilot, at).predicted_seconds);
  CHECK(plan_grid(0, point, pilot, at).predicted_build_seconds >
        plan_grid(0, spot, pilot, at).predicted_build_seconds);
}

TEST_CASE("A grid is not built for few rays, of which threads make fewer") {
  const std::string_view too_few = "too few rays are expected: it would cost more than it saves";
  GridPilot few = pilot;
  few.expected_rays = 3.0e5;
  CHECK(plan_grid(0, point, few, {.bvh_build_seconds = 2}).reason == too_few);
  CHECK(!plan_grid(0, point, few, {.bvh_build_seconds = 2}).build);
  CHECK(plan_grid(0, point, few, {.bvh_build_seconds = 0.5}).build);
  CHECK(plan_grid(0, point, pilot, {.bvh_build_seconds = 1, .threads = 2}).build);
  CHECK(plan_grid(0, point, pilot, {.bvh_build_seconds = 1, .threads = 3}).reason == too_few);
}

TEST_CASE("A grid is not built beyond the memory that is left") {
  GridCircumstances at{.triangles = 1000, .memory_left = 40'000};
  CHECK(plan_grid(0, point, pilot, at).build);
  --at.memory_left;
  CHECK(!plan_grid(0, point, pilot, at).build);
  CHECK(plan_grid(0, point, pilot, at).reason == would_be_too_large);
}

TEST_CASE("A grid that was built stays if it is faster and fits") {
  const GridCircumstances at{.bvh_build_seconds = 1, .threads = 2, .memory_left = 1000};
  const GridPlan planned = plan_grid(0, point, pilot, at);
  GridPlan plan = planned;
  measure_grid(plan, 2e-6, 3, 1000, at);
  CHECK(plan.build);
  CHECK(plan.reason == planned.reason);
  CHECK(plan.measured_seconds == 2e-6);
  CHECK(*plan.measured_saving == Approx(1e6 * 8e-6 / 2 - 3));

  plan = planned;
  measure_grid(plan, 2e-6, 3, 1001, at);
  CHECK(!plan.build);
  CHECK(plan.reason == is_too_large);

  plan = planned;
  measure_grid(plan, pilot.seconds, 3, 1000, at);
  CHECK(!plan.build);
  CHECK(plan.reason == "the pilot's rays were no faster once it was built");
}

TEST_CASE("Scenes that cannot profit get no grids") {
  Scene scene = lit_ball();
  SECTION("no derived areas") {
    scene.influence_areas.derive = false;
    check_reason(scene, "the scene asks for no derived areas");
  }
  SECTION("few triangles") {
    scene.meshes = {make_mesh(SphereShape{})};
    check_reason(scene, "with so few triangles the BVH is as fast as a grid");
  }
  SECTION("no shadow rays") {
    scene.render.strategy = Strategy::bsdf;
    check_reason(scene, "no shadow rays are sent");
  }
  SECTION("opacity") {
    scene.materials[0].opacity.value = 0.5F;
    check_reason(scene, "some surfaces are partly transparent, so shadow rays need nearest hits");
  }
  SECTION("a texture of opacity") {
    scene.textures.emplace_back(CheckerTexture{});
    scene.materials[0].opacity.texture = 0;
    check_reason(scene, "some surfaces are partly transparent, so shadow rays need nearest hits");
  }
  SECTION("a material that nothing has") {
    scene.materials.push_back({"mask", DiffuseMaterial{}});
    scene.materials.back().opacity.value = 0.5F;
    CHECK(no_grids(make_world(scene), scene).empty());
  }
}

TEST_CASE("Only lights whose rays share a point or almost a direction have plans") {
  Scene scene = lit_ball();
  scene.lights.push_back({"sun", DirectionalLight{}});
  scene.lights.push_back({"sky", EnvironmentLight{}});
  const World world = make_world(scene);
  const Acceleration acceleration = make_acceleration(world, scene);
  REQUIRE(acceleration.grid_plans.size() == 3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    CHECK(acceleration.grid_plans[i].bundle == i);
    CHECK(!acceleration.grid_plans[i].reason.empty());
  }
}

TEST_CASE("No grid is built where memory suffices for the BVH only") {
  Scene scene = lit_ball();
  const World world = make_world(scene);
  for (const std::uint64_t more : {std::uint64_t{0}, 39 * world.triangles().size()}) {
    scene.acceleration.memory = bytes_of_bvh(world) + more;
    const Acceleration acceleration = make_acceleration(world, scene);
    CHECK(acceleration.name == "bvh");
    CHECK(acceleration.accelerator->memory().total() <= *scene.acceleration.memory);
    for (const GridPlan& plan : acceleration.grid_plans) {
      CHECK(!plan.build);
      CHECK(plan.reason == would_be_too_large);
    }
  }
}

TEST_CASE("Memory stays within the limit of a scene") {
  Scene scene = lit_ball();
  const World world = make_world(scene);
  const AcceleratorMemory all = make_acceleration(world, scene, "light").accelerator->memory();
  REQUIRE(all.light_grids > 0);
  for (const std::string_view name : {"", "light"}) {
    for (std::uint64_t part = 0; part <= 12; ++part) {
      scene.acceleration.memory = all.global_bvh + (all.total() - all.global_bvh) * part / 12;
      const Acceleration acceleration = make_acceleration(world, scene, name);
      CHECK(acceleration.accelerator->memory().total() <= *scene.acceleration.memory);
    }
  }
}

TEST_CASE("Requested grids that exceed the memory are left out") {
  Scene scene = lit_ball();
  const World world = make_world(scene);
  const Acceleration all = make_acceleration(world, scene, "light");
  for (const GridPlan& plan : all.grid_plans) CHECK(plan.reason == "asked for");
  REQUIRE(all.grids->reports().size() == 2);

  scene.acceleration.memory = all.accelerator->memory().total() - 1;
  const Acceleration some = make_acceleration(world, scene, "light");
  CHECK(some.name == "light");
  CHECK(some.grids->reports().size() == 1);
  CHECK(std::ranges::count(some.grid_plans, true, &GridPlan::build) == 1);
  CHECK(std::ranges::count(some.grid_plans, "it takes more memory than the scene allows",
                           &GridPlan::reason) == 1);
}

TEST_CASE("Declared areas are built as far as memory allows") {
  Scene scene = lit_ball();
  for (const double far : {6.0, 5.0, 4.1}) {
    PointAreaDeclaration area;
    area.light = "bulb";
    area.far = far;
    scene.influence_areas.declared.emplace_back(area);
  }
  const World world = make_world(scene);
  const Acceleration all = make_acceleration(world, scene);
  REQUIRE(all.local->reports().size() == 3);
  const std::uint64_t enough = all.accelerator->memory().total();
  const auto built = [&](std::uint64_t memory) {
    scene.acceleration.memory = memory;
    const Acceleration acceleration = make_acceleration(world, scene);
    CHECK(acceleration.name == "local");
    CHECK(acceleration.accelerator->memory().total() <= memory);
    std::vector<bool> are_built;
    for (const auto& [area, plan, built_index] : acceleration.areas) {
      if (!area.declared) continue;
      are_built.push_back(plan.build);
      CHECK(plan.reason == (plan.build ? "declared" : would_be_too_large));
    }
    CHECK(acceleration.local->reports().size() ==
          static_cast<std::size_t>(std::ranges::count(are_built, true)));
    return are_built;
  };
  CHECK(built(enough) == std::vector{true, true, true});
  CHECK(built(enough - 1) == std::vector{true, true, false});
  CHECK(built(enough - all.local->reports()[2].bytes - 1'000) == std::vector{true, false, true});
  CHECK(built(bytes_of_bvh(world)) == std::vector{false, false, false});
}
