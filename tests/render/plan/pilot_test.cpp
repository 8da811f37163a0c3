// Tests the pilot, which estimates the kind and number of a light's shadow rays.
#include "render/plan/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <pah/scene/shapes.hpp>
#include <utility>

#include "catch.hpp"

using namespace pah;

namespace {

// A floor that fills the picture.
Scene floor_scene() {
  Scene scene;
  PerspectiveCamera camera;
  camera.position = {0, 3, 0};
  camera.look_at = {0, 0, 0};
  camera.up = {0, 0, 1};
  scene.camera = camera;
  scene.film.width = 100;
  scene.film.height = 80;
  scene.render.samples = 16;
  scene.render.max_depth = 1;
  scene.materials.push_back({"gray", DiffuseMaterial{}});
  scene.meshes = {make_mesh(RectangleShape{{1000, 1000}})};
  scene.instances.emplace_back();
  return scene;
}

void add_sun(Scene& scene, DVec3 direction, double angle = 0) {
  scene.lights.push_back({"sun", DirectionalLight{direction, Vec3(1), angle}});
}

std::vector<PilotRays> pilot_of(const Scene& scene) {
  const World world = make_world(scene);
  std::vector<PilotLight> lights;
  for (std::size_t i = 0; i < world.lights.size(); ++i)
    if (const auto rays = exact_bundle(world.lights[i]))
      lights.push_back({static_cast<LightId>(i), *rays});
  return pilot_rays(world, scene, *make_global_bvh(world.triangles()), lights);
}

constexpr double samples = 100 * 80 * 16;

}  // namespace

TEST_CASE("Every sample of a floor that fills the picture sends a ray to the sun") {
  Scene scene = floor_scene();
  add_sun(scene, {0, -1, 0.2});
  CHECK(pilot_of(scene).at(0).expected == Approx(samples).epsilon(0.02));
  // Paths leave the scene.
  scene.render.max_depth = 8;
  CHECK(pilot_of(scene).at(0).expected == Approx(samples).epsilon(0.02));
  scene.film.crop = PixelRect{0, 50, 0, 40};
  CHECK(pilot_of(scene).at(0).expected == Approx(samples / 4).epsilon(0.02));
}

TEST_CASE("Lights share the rays, also lights without a bundle") {
  Scene scene = floor_scene();
  add_sun(scene, {0, -1, 0.2});
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 4, 0), Vec3(10)}});
  scene.lights.push_back({"sky", EnvironmentLight{}});
  const std::vector<PilotRays> pilots = pilot_of(scene);
  REQUIRE(pilots.size() == 2);
  for (const PilotRays& pilot : pilots) CHECK(pilot.expected == Approx(samples / 3).epsilon(0.02));
}

TEST_CASE("Paths continue within a closed room and are counted three times") {
  Scene scene = floor_scene();
  scene.meshes = {make_mesh(BoxShape{{8, 8, 8}})};
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 1, 0), Vec3(10)}});
  for (const auto& [depth, met] : {std::pair{1, 1}, {2, 2}, {3, 3}, {8, 3}}) {
    scene.render.max_depth = depth;
    CHECK(pilot_of(scene).at(0).expected == Approx(met * samples).epsilon(0.02));
  }
}

TEST_CASE("A light behind all that the camera sees gets no rays") {
  Scene scene = floor_scene();
  scene.render.max_depth = 8;
  SECTION("sun") { add_sun(scene, {0, 1, 0.2}); }
  SECTION("bulb") { scene.lights.push_back({"bulb", PointLight{DVec3(0, -4, 0), Vec3(10)}}); }
  SECTION("spot aside") {
    scene.lights.push_back({"spot", SpotLight{DVec3(0, 4, 0), DVec3(0, 1, 0)}});
  }
  const std::vector<PilotRays> pilots = pilot_of(scene);
  REQUIRE(pilots.size() == 1);
  CHECK(pilots[0].rays.empty());
  CHECK(pilots[0].expected == 0);
}

TEST_CASE("A spot gets rays of what lies in its cone") {
  Scene scene = floor_scene();
  scene.lights.push_back({"spot", SpotLight{DVec3(0, 4, 0), DVec3(0, -1, 0), Vec3(1), 10}});
  const double expected = pilot_of(scene).at(0).expected;
  CHECK(expected > 0);
  CHECK(expected < samples / 2);
}

TEST_CASE("A pilot's rays name their light, and lead there") {
  Scene scene = floor_scene();
  scene.lights.push_back({"sky", EnvironmentLight{}});
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 2, 0), Vec3(10)}});
  add_sun(scene, {0, -1, 0}, 20);
  const std::vector<PilotRays> pilots = pilot_of(scene);
  REQUIRE(pilots.size() == 2);
  const DVec3 origin = make_world(scene).origin;
  for (const Ray& ray : pilots[0].rays) {
    CHECK(ray.bundle == 1);
    CHECK(glm::length(DVec3(ray.origin) + DVec3(ray.direction) + origin - DVec3(0, 2, 0)) < 1e-4);
  }
  float lowest = 1;
  for (const Ray& ray : pilots[1].rays) {
    CHECK(ray.bundle == 2);
    lowest = std::min(lowest, ray.direction.y);
  }
  CHECK(lowest == Approx(std::cos(glm::radians(10.0))).margin(0.003));
}

TEST_CASE("A pilot's rays depend on the seed alone") {
  Scene scene = floor_scene();
  scene.render.max_depth = 3;
  scene.meshes = {make_mesh(BoxShape{{8, 8, 8}})};
  add_sun(scene, {0, -1, 0.2}, 1);
  scene.lights.push_back({"bulb", PointLight{DVec3(0, 1, 0), Vec3(10)}});
  const auto same = [](const std::vector<PilotRays>& a, const std::vector<PilotRays>& b) {
    const auto same_ray = [](const Ray& x, const Ray& y) {
      return x.origin == y.origin && x.direction == y.direction && x.t_max == y.t_max;
    };
    return std::ranges::equal(a, b, [&](const PilotRays& x, const PilotRays& y) {
      return x.expected == y.expected && std::ranges::equal(x.rays, y.rays, same_ray);
    });
  };
  const std::vector<PilotRays> first = pilot_of(scene);
  CHECK(same(first, pilot_of(scene)));
  scene.render.seed = 1;
  CHECK(!same(first, pilot_of(scene)));
}

TEST_CASE("An empty scene has no pilot's rays") {
  Scene scene = floor_scene();
  scene.meshes.clear();
  scene.instances.clear();
  add_sun(scene, {0, -1, 0});
  CHECK(pilot_of(scene).at(0).rays.empty());
  scene.film.crop = PixelRect{3, 3, 3, 3};
  CHECK(pilot_of(scene).at(0).expected == 0);
}
