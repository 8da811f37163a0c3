#include <pah/render/acceleration.hpp>
#include <pah/render/render.hpp>
#include <pah/scene/shapes.hpp>

#include "catch.hpp"
#include "support/fewer.hpp"

using namespace pah;

namespace {

// A ball on a floor under a bulb, with an area declared for the bulb.
Scene scene_with_area() {
  Scene scene;
  PerspectiveCamera camera;
  camera.position = {0, 2, 5};
  camera.look_at = {0, 0.5, 0};
  scene.camera = camera;
  scene.film.width = 16;
  scene.film.height = 12;
  scene.render.samples = 2;
  scene.materials.push_back({"gray", DiffuseMaterial{}});
  scene.meshes = {make_mesh(SphereShape{}), make_mesh(RectangleShape{})};
  for (std::uint32_t i = 0; i < 2; ++i) {
    Instance instance;
    instance.mesh = i;
    scene.instances.push_back(instance);
  }
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 4, 0), Vec3(10)}});
  PointAreaDeclaration area;
  area.light = "bulb";
  area.far = 5;
  scene.influence_areas.declared = {area};
  return scene;
}

}  // namespace

TEST_CASE("Acceleration uses the areas that a scene declares, and changes no pixel") {
  const Scene scene = scene_with_area();
  const World world = make_world(scene);
  const Acceleration acceleration = make_acceleration(world, scene);
  CHECK(acceleration.name == "local");
  REQUIRE(acceleration.local != nullptr);
  RenderOptions options;
  options.count_traversal = true;
  const Film by_areas =
      render(world, *acceleration.accelerator, scene.film, scene.render, options).film;
  REQUIRE(acceleration.local->uses().size() == 1);
  CHECK(acceleration.local->uses()[0].answered > 0);

  const Acceleration oracle = make_acceleration(world, scene, "brute_force");
  const Film expected = render(world, *oracle.accelerator, scene.film, scene.render).film;
  REQUIRE(by_areas.pixels.size() == expected.pixels.size());
  for (std::size_t i = 0; i < expected.pixels.size(); ++i)
    CHECK(by_areas.pixels[i].sum == expected.pixels[i].sum);
}

TEST_CASE("Declared areas are built, derived ones are not yet worth it") {
  Scene scene = scene_with_area();
  const World world = make_world(scene);
  const Acceleration acceleration = make_acceleration(world, scene);
  CHECK(acceleration.areas.size() > 1);
  for (const AreaStatus& status : acceleration.areas) {
    CHECK(status.plan.build == status.area.declared);
    CHECK(!status.plan.reason.empty());
  }
  scene.influence_areas.declared.clear();
  CHECK(make_acceleration(world, scene).name == "bvh");
}

TEST_CASE("Lights with enough rays get grids") {
  // Skipped under sanitizers, which change the ratio of times.
  if (test::sanitized) return;
  Scene scene = scene_with_area();
  scene.influence_areas.declared.clear();
  const std::size_t small = make_world(scene).triangles().size();
  Mesh& mesh = scene.meshes.front();
  mesh.triangles.insert(mesh.triangles.end(), 20'000, mesh.triangles.front());
  const World world = make_world(scene);
  REQUIRE(world.triangles().size() > small + 10'000);

  scene.render.samples = 1 << 20;
  const Acceleration acceleration = make_acceleration(world, scene);
  CHECK(acceleration.name == "light");
  REQUIRE(acceleration.grids != nullptr);
  REQUIRE(!acceleration.grid_plans.empty());
  for (const GridPlan& plan : acceleration.grid_plans) CHECK(plan.build);
  CHECK(acceleration.grids->reports().size() == acceleration.grid_plans.size());

  scene.influence_areas.derive = false;
  CHECK(make_acceleration(world, scene).name == "bvh");
  scene.influence_areas.derive = true;
  scene.render.samples = 1;
  const Acceleration few = make_acceleration(world, scene);
  CHECK(few.name == "bvh");
  for (const GridPlan& plan : few.grid_plans) CHECK(!plan.build);
}

TEST_CASE("The named accelerator is made, and no other") {
  const Scene scene = scene_with_area();
  const World world = make_world(scene);
  for (const AcceleratorName& known : accelerator_names()) {
    const Acceleration acceleration = make_acceleration(world, scene, known.name);
    CHECK(acceleration.name == known.name);
    CHECK((acceleration.local != nullptr) == (known.name == "local"));
    CHECK((acceleration.grids != nullptr) == (known.name == "light"));
    for (const AreaStatus& status : acceleration.areas)
      if (known.name != "local") CHECK(!status.plan.build);
  }
  CHECK_THROWS_AS(make_acceleration(world, scene, "bvhh"), std::invalid_argument);
}
