// Scenes that load: what they become.
#include <pah/io/load_scene.hpp>

#include "catch.hpp"
#include "scene_testing.hpp"

using namespace pah;

TEST_CASE("a scene with nothing in it has every default") {
  const Scene scene = load("x-nothing: 1\n").scene;
  const auto& camera = std::get<PerspectiveCamera>(scene.camera);
  CHECK(camera.fov == 45);
  CHECK(scene.film.width == 960);
  CHECK(scene.render.samples == 64);
  CHECK(scene.influence_areas.derive);
  CHECK(scene.instances.empty());
}

TEST_CASE("a Cornell box loads") {
  const Scene scene = load(R"(
camera:   {type: perspective, position: [0, 1, 3.4], look_at: [0, 1, 0], fov: 40}
film:     {width: 64, height: 64}
render:   {samples: 16, max_depth: 8, seed: 7}
materials:
  white: {type: diffuse, reflectance: [0.73, 0.73, 0.73]}
  red:   {type: diffuse, reflectance: [0.63, 0.06, 0.05]}
  brass: {type: metal, preset: Cu, roughness: 0.2}
meshes:
  - {name: floor, shape: rectangle, size: [2, 2], material: white}
  - {name: ceiling, shape: rectangle, size: [2, 2], material: white, transform: [{rotate: {axis: x, angle: 180}}, {translate: [0, 2, 0]}]}
  - {name: left, shape: rectangle, size: [2, 2], material: red, transform: [{rotate: {axis: z, angle: -90}}, {translate: [-1, 1, 0]}]}
  - {name: box, shape: box, size: [0.6, 0.6, 0.6], material: brass, transform: [{rotate: {axis: y, angle: 17}}, {translate: [0.3, 0.3, 0.3]}]}
lights:
  - {name: panel, type: area, shape: rectangle, size: [0.5, 0.5], radiance: 12, transform: [{rotate: {axis: x, angle: 180}}, {translate: [0, 1.99, 0]}]}
)")
                          .scene;
  CHECK(scene.film.width == 64);
  REQUIRE(scene.instances.size() == 5);
  REQUIRE(scene.lights.size() == 1);
  CHECK(scene.lights[0].name == "panel");
  CHECK(scene.instances[4].light == 0);
  CHECK(scene.instances[0].light == no_light);
  CHECK(std::get<AreaLight>(scene.lights[0].model).radiance == Vec3(12));
  // The left wall faces +x: its y axis is turned onto x exactly.
  CHECK(scene.instances[2].world_from_object[1] == DVec3(1, 0, 0));
  CHECK(scene.materials[scene.instances[2].material].name == "red");
}
