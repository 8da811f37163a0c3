// Tests conservation of energy in scenes whose radiance is the same in every direction.
#include "analytic_scenes.hpp"
#include "catch.hpp"

using namespace pah;
using namespace pah::test;

namespace {

void check_radiance_one(const Scene& scene, double tolerance = 1e-3) {
  const RenderResult result = render_scene(scene);
  const Estimate e = estimate(result.film);
  INFO("mean " << e.mean << " +- " << e.sigma);
  CHECK(result.counts.nan_samples == 0);
  CHECK(sigmas_off(e, 1) < 4);
  CHECK(std::abs(e.mean - 1) < tolerance);
}

// A ball that fills the picture, under a constant sky of radiance 1.
SceneBuilder ball_under_sky(MaterialModel material, int samples) {
  SceneBuilder builder;
  builder.add(SphereShape{0.5, 64, 32}, builder.material(std::move(material)));
  builder.light(EnvironmentLight{});
  builder.look({0, 0.3, 4}, {0, 0, 0}, 10);
  builder.film(32, samples);
  builder.scene.render.max_depth = 64;
  return builder;
}

// Radiance is 1 anywhere inside a closed emitter of radiance 1.
void check_closed_emitters(int samples, double tolerance) {
  const std::array<Shape, 3> shapes{SphereShape{2, 32, 16}, BoxShape{{3, 2, 4}},
                                    TorusShape{2, 1.5, 24, 16}};
  for (const Shape& shape : shapes) {
    for (const Strategy strategy : {Strategy::mis, Strategy::nee, Strategy::bsdf}) {
      SceneBuilder builder;
      const LightId shell = builder.light(AreaLight{Vec3(1), true});
      builder.add(shape, 0, glm::dmat4(1), shell);
      builder.add(BoxShape{{0.5, 0.5, 0.5}}, builder.diffuse(1), moved({1.2, 0.2, 0}));
      builder.look({1.3, 0.4, 1}, {1.2, 0.1, 0}, 50);
      builder.film(32, samples);
      builder.scene.render.max_depth = 64;
      builder.scene.render.strategy = strategy;
      INFO("shape " << shape.index() << " strategy " << static_cast<int>(strategy));
      check_radiance_one(builder.scene, tolerance);
    }
  }
}

}  // namespace

TEST_CASE("White furnace: a white diffuse box, inside and out, under a constant sky") {
  SceneBuilder builder;
  builder.add(BoxShape{}, builder.diffuse(1), turned(30, glm::normalize(DVec3(1, 2, 3))));
  builder.light(EnvironmentLight{});
  builder.look({0, 0.3, 4}, {0, 0, 0}, 10);
  builder.film(32, 1024);
  for (const Strategy strategy : {Strategy::mis, Strategy::nee, Strategy::bsdf}) {
    builder.scene.render.strategy = strategy;
    check_radiance_one(builder.scene);
  }
}

TEST_CASE("White furnace: an open white box keeps no light to itself") {
  SceneBuilder builder;
  const MaterialId white = builder.diffuse(1);
  builder.add(RectangleShape{{2, 2}}, white, moved({0, -0.3, 0}));
  for (const double angle : {0.0, 90.0, 180.0}) {
    builder.add(RectangleShape{{1, 0.6}}, white,
                turned(angle, {0, 1, 0}) * moved({0, 0, -0.5}) * turned(90, {1, 0, 0}));
  }
  builder.light(EnvironmentLight{});
  builder.look({0, 3, 1.5}, {0, 0, 0}, 20);
  builder.film(32, 1024);
  builder.scene.render.max_depth = 1000;
  check_radiance_one(builder.scene);
}

TEST_CASE("White furnace: a coarse ball with smooth normals does not shadow itself") {
  for (const Strategy strategy : {Strategy::mis, Strategy::nee, Strategy::bsdf}) {
    SceneBuilder builder = ball_under_sky(DiffuseMaterial{{Vec3(1), no_texture}}, 64);
    builder.scene.meshes[0] = make_mesh(SphereShape{0.5, 24, 12});
    builder.scene.render.strategy = strategy;
    check_radiance_one(builder.scene);
  }
}

TEST_CASE("White furnace: glass and mirror") {
  check_radiance_one(ball_under_sky(GlassMaterial{}, 256).scene);
  check_radiance_one(ball_under_sky(MirrorMaterial{}, 16).scene);
}

TEST_CASE("White furnace: glass and mirror, a million samples", "[full]") {
  check_radiance_one(ball_under_sky(GlassMaterial{}, 1024).scene);
  check_radiance_one(ball_under_sky(MirrorMaterial{}, 1024).scene);
}

TEST_CASE("Radiance is 1 anywhere inside a closed emitter") { check_closed_emitters(128, 1e-2); }
TEST_CASE("Radiance is 1 anywhere inside a closed emitter, a million samples", "[full]") {
  check_closed_emitters(1024, 5e-3);
}

TEST_CASE("An emitter is as bright within glass, through a mask and when seen directly") {
  SceneBuilder builder;
  const LightId lamp = builder.light(AreaLight{Vec3(1), false});
  builder.add(SphereShape{0.2, 16, 8}, 0, glm::dmat4(1), lamp);
  builder.look({0, 0, 4}, {0, 0, 0}, 1);
  builder.film(8, 16);
  builder.scene.render.max_depth = 0;
  CHECK(estimate(builder.scene).mean == 1);

  // Two half-opaque black panes let a quarter of the light through.
  Material half{"half", DiffuseMaterial{{Vec3(0), no_texture}}};
  half.opacity.value = 0.5F;
  builder.scene.materials.push_back(half);
  const auto id = static_cast<MaterialId>(builder.scene.materials.size() - 1);
  for (const double z : {1.0, 2.0}) {
    builder.add(RectangleShape{{1, 1}}, id, moved({0, 0, z}) * turned(90, {1, 0, 0}));
  }
  builder.film(32, 1024);
  CHECK(sigmas_off(estimate(builder.scene), 0.25) < 4);
}

TEST_CASE("Masked surfaces dim shadow segments like rays") {
  for (const Strategy strategy : {Strategy::nee, Strategy::bsdf, Strategy::mis}) {
    SceneBuilder builder;
    builder.add(RectangleShape{{2, 2}}, builder.diffuse(1));
    builder.light(EnvironmentLight{});
    Material veil{"veil", DiffuseMaterial{{Vec3(0), no_texture}}};
    veil.opacity.value = 0.25F;
    builder.scene.materials.push_back(veil);
    // A closed shell around everything: light crosses it once, camera rays never.
    builder.add(SphereShape{3, 24, 12},
                static_cast<MaterialId>(builder.scene.materials.size() - 1));
    builder.look({0, 2, 0.5}, {0, 0, 0}, 10);
    builder.film(16, 1024);
    builder.scene.render.strategy = strategy;
    const Estimate e = estimate(builder.scene);
    INFO("strategy " << static_cast<int>(strategy) << ": " << e.mean << " +- " << e.sigma);
    CHECK(sigmas_off(e, 0.75) < 4);
  }
}
