#include "report/inspect/area_ray_costs.hpp"

#include <pah/render/acceleration.hpp>

#include "bvh/build.hpp"
#include "catch.hpp"
#include "floor_below.hpp"

using namespace pah;

namespace {

constexpr std::uint64_t pixels = 16 * 16;

std::vector<AreaRayCosts> costs_of(const Scene& scene) {
  const World world = make_world(scene);
  std::vector<LocalArea> areas;
  for (const SceneArea& area : areas_of(world, scene.influence_areas, scene.film))
    areas.push_back(local_area(area));
  return measure_area_costs(world, build_bvh(world.triangles()).bvh, areas,
                            scene.acceleration.local, scene.film);
}

}  // namespace

TEST_CASE("Rays that an area answers cost what its BVH costs") {
  Scene scene = test::floor_below();
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 3, 0), Vec3(10)}});
  const std::vector<AreaRayCosts> costs = costs_of(scene);
  // In either BVH a ray costs one node and a block of two triangles.
  const double each = double{box_cost} + double{triangle_cost};
  std::uint64_t to_bulb = 0;
  for (std::size_t i = 0; i + 1 < costs.size(); ++i) to_bulb += costs[i].rays;
  CHECK(to_bulb == pixels);
  CHECK(costs.back().rays == pixels);  // the camera's
  for (const AreaRayCosts& area : costs) {
    CHECK(area.answered == area.rays);
    CHECK(area.local == Approx(area.rays > 0 ? each : 0));
    CHECK(area.global == Approx(area.rays > 0 ? each : 0));
  }
}

TEST_CASE("Rays that an area cannot answer cost what both BVHs cost") {
  Scene scene = test::floor_below();
  scene.lights.push_back({"sun", DirectionalLight{{0, -1, 0}, Vec3(1), 0}});
  // A floor that the area does not reach.
  scene.meshes.push_back(scene.meshes.front());
  scene.instances.emplace_back().mesh = 1;
  scene.instances.back().world_from_object[3] = DVec3(0, 10, 0);
  scene.influence_areas.derive = false;
  scene.influence_areas.declared = {
      PlaneAreaDeclaration{"sun", DVec3(0, 2, 0), DVec3(0, -1, 0), DVec2(2000), 3}};
  const std::vector<AreaRayCosts> costs = costs_of(scene);
  REQUIRE(costs.size() == 1);
  CHECK(costs[0].rays == pixels);
  CHECK(costs[0].answered == 0);
  const double floor_alone = double{box_cost} + double{triangle_cost};
  CHECK(costs[0].global >= floor_alone);
  CHECK(costs[0].local == Approx(floor_alone + costs[0].global));
}
