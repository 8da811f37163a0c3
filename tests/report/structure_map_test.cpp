#include "report/inspect/pictures/structure_map.hpp"

#include <algorithm>

#include "catch.hpp"
#include "floor_below.hpp"

using namespace pah;

namespace {

Scene floor_under_bulb() {
  Scene scene = test::floor_below();
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 3, 0), Vec3(10)}});
  return scene;
}

StructureMap map_of(const Scene& scene, std::string_view accelerator = {}) {
  const World world = make_world(scene);
  return map_structures(world, make_acceleration(world, scene, accelerator), scene.film);
}

bool is_all(const StructureMap& map, const Vec3& color) {
  return map.image.pixels.size() == 16 * 16 &&
         std::ranges::all_of(map.image.pixels, [&](const Vec3& pixel) { return pixel == color; });
}

}  // namespace

TEST_CASE("Without areas and grids the global BVH answers all shadow rays") {
  const StructureMap map = map_of(floor_under_bulb());
  CHECK(map.image.width == 16);
  CHECK(map.image.height == 16);
  REQUIRE(map.legend.size() == 1);
  CHECK(legend_text(map.legend) == "  gray      global BVH\n");
  CHECK(is_all(map, map.legend[0].color));
}

TEST_CASE("A declared area answers the shadow rays that start in it") {
  Scene scene = floor_under_bulb();
  PointAreaDeclaration area;
  area.light = "bulb";
  area.fov = {60, 60};
  area.far = 5;
  scene.influence_areas.declared = {area};
  const StructureMap map = map_of(scene);
  REQUIRE(map.legend.size() == 2);
  CHECK(map.legend[1].label == "area bulb");
  CHECK(map.image.at(8, 8) == map.legend[1].color);
  CHECK(map.image.at(0, 0) == map.legend[0].color);
  CHECK(std::ranges::count(map.image.pixels, map.legend[1].color) > 4);
}

TEST_CASE("A grid answers the shadow rays of its light, others share the pixel") {
  Scene scene = floor_under_bulb();
  const StructureMap alone = map_of(scene, "light");
  REQUIRE(alone.legend.size() == 2);
  CHECK(alone.legend[1].label == "grid of bulb");
  CHECK(is_all(alone, alone.legend[1].color));

  scene.lights.push_back({"sky", EnvironmentLight{}});
  const StructureMap both = map_of(scene, "light");
  CHECK(is_all(both, (both.legend[0].color + both.legend[1].color) / 2.0F));
}

TEST_CASE("Pixels without shadow rays are black") {
  Scene scene = floor_under_bulb();
  SECTION("no surface") { scene.instances.clear(); }
  SECTION("no light") { scene.lights.clear(); }
  SECTION("a light behind") { std::get<PointLight>(scene.lights[0].model).position = {0, -3, 0}; }
  CHECK(is_all(map_of(scene), Vec3(0)));
}

TEST_CASE("Neighbors in the legend have different colors, however many there are") {
  Scene scene = floor_under_bulb();
  scene.influence_areas.declared.assign(12, PointAreaDeclaration{.light = "bulb"});
  const StructureMap map = map_of(scene);
  REQUIRE(map.legend.size() == 13);
  for (std::size_t i = 1; i < map.legend.size(); ++i) {
    CHECK(map.legend[i].color != map.legend[i - 1].color);
    CHECK(map.legend[i].color != map.legend[0].color);
  }
}
