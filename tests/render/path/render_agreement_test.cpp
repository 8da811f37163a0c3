// Tests that settings which change the noise of a picture do not change its mean.
#include <chrono>
#include <thread>

#include "analytic_scenes.hpp"
#include "catch.hpp"
#include "support/fewer.hpp"

using namespace pah;
using namespace pah::test;

namespace {

// A small room with all kinds of lights and materials.
SceneBuilder room(double scale = 1, DVec3 offset = DVec3(0)) {
  SceneBuilder builder(scale, offset);
  const MaterialId white = builder.diffuse(0.7F);
  builder.add(RectangleShape{{4, 4}}, white);
  builder.add(RectangleShape{{4, 4}}, white, moved({0, 2, -2}) * turned(90, {1, 0, 0}));
  builder.add(SphereShape{0.4, 32, 16}, builder.material(GlassMaterial{}), moved({-0.6, 0.4, 0.2}));
  builder.add(SphereShape{0.4, 32, 16}, builder.material(PlasticMaterial{}),
              moved({0.5, 0.4, 0.4}));
  MetalMaterial metal;
  metal.roughness.value = 0.4F;
  builder.add(BoxShape{{0.4, 0.8, 0.4}}, builder.material(metal), moved({0, 0.4, -0.8}));
  GlassMaterial frosted;
  frosted.roughness.value = 0.5F;
  builder.add(BoxShape{{0.5, 0.5, 0.5}}, builder.material(frosted), moved({1.1, 0.3, -0.4}));
  const LightId panel = builder.light(AreaLight{Vec3(6), false});
  builder.add(RectangleShape{{1, 1}}, white, moved({0, 2, 0}) * turned(180, {1, 0, 0}), panel);
  builder.light(EnvironmentLight{Vec3(0.3F)});
  builder.light(DirectionalLight{{1, -1, -0.4}, Vec3(0.5F), 40});
  builder.light(PointLight{{-1, 1.2, 1}, Vec3(0.4F)});
  builder.light(SpotLight{{1, 1.8, 1}, {-0.5, -1, -0.5}, Vec3(1.5F), 25});
  builder.look({0, 1, 4}, {0, 0.6, 0}, 35);
  builder.film(32, 64);
  builder.scene.render.max_depth = 5;
  builder.scene.render.roulette_depth = 100;
  return builder;
}

// A coarse body that stands for a smooth one and touches the floor, under a large lamp nearby.
SceneBuilder coarse_ball() {
  SceneBuilder builder;
  builder.add(RectangleShape{{4, 4}}, builder.diffuse(0.7F));
  builder.add(SphereShape{0.5, 10, 5}, builder.material(PlasticMaterial{}), moved({0, 0.5, 0}));
  const LightId panel = builder.light(AreaLight{Vec3(6), true});
  builder.add(RectangleShape{{0.8, 0.8}}, 0, moved({0.8, 0.8, 0}) * turned(60, {0, 0, 1}), panel);
  builder.look({0, 1.5, 4}, {0, 0.5, 0}, 20);
  builder.film(32, 64);
  return builder;
}

void check_strategies_agree(Scene scene) {
  scene.render.samples = fewer_if_sanitized(1024);
  std::array<Estimate, 3> e;
  for (std::size_t i = 0; i < 3; ++i) {
    scene.render.strategy = std::array{Strategy::mis, Strategy::nee, Strategy::bsdf}[i];
    scene.render.seed = i;
    e[i] = estimate(scene);
  }
  INFO("mis " << e[0].mean << " +- " << e[0].sigma << ", nee " << e[1].mean << " +- " << e[1].sigma
              << ", bsdf " << e[2].mean << " +- " << e[2].sigma);
  CHECK(welch_p(e[0], e[1]) > 0.01);
  CHECK(welch_p(e[0], e[2]) > 0.01);
  CHECK(welch_p(e[1], e[2]) > 0.01);
}

}  // namespace

TEST_CASE("Next-event estimation, BSDF sampling and both together agree") {
  check_strategies_agree(room().scene);
  check_strategies_agree(coarse_ball().scene);
}

TEST_CASE("Russian roulette does not change the mean") {
  Scene scene = room().scene;
  scene.render.samples = fewer_if_sanitized(512);
  const Estimate without = estimate(scene);
  scene.render.roulette_depth = 1;
  scene.render.seed = 1;
  const Estimate with = estimate(scene);
  INFO(without.mean << " +- " << without.sigma << " and " << with.mean << " +- " << with.sigma);
  CHECK(welch_p(without, with) > 0.01);
}

TEST_CASE("A scene scaled by a power of two gives the identical picture") {
  const auto film_at = [](int exponent) {
    Scene scene = room(std::ldexp(1.0, exponent)).scene;
    scene.film.width = scene.film.height = 12;
    scene.render.samples = 8;
    return render_scene(scene).film;
  };
  const Film at_one = film_at(0);
  for (int exponent = -20; exponent <= 20; ++exponent) {
    CAPTURE(exponent);
    CHECK(identical(at_one, film_at(exponent)));
  }
}

TEST_CASE("Neither the unit of length nor the place changes the mean") {
  Scene scene = room().scene;
  scene.render.samples = fewer_if_sanitized(256);
  const Estimate reference = estimate(scene);
  std::uint64_t seed = 1;
  const auto check = [&](double scale, DVec3 offset) {
    Scene other = room(scale, offset).scene;
    other.render.samples = scene.render.samples;
    other.render.seed = seed++;
    const Estimate e = estimate(other);
    INFO("scale " << scale << " offset " << offset.x << ": " << e.mean << " +- " << e.sigma
                  << " against " << reference.mean << " +- " << reference.sigma);
    CHECK(welch_p(reference, e) > 0.001);
  };
  for (const double scale : {1e-6, 1e-3, 1e4, 1e7}) check(scale, DVec3(0));
  for (const double scale : {1e-6, 1.0, 1e7}) check(scale, DVec3(4e6, -4e6, 4e6) * scale);
}

TEST_CASE("Pictures do not depend on the number of threads", "[threads]") {
  const Scene scene = room().scene;
  RenderOptions options;
  options.threads = 1;
  const RenderResult one = render_scene(scene, options);
  CHECK(one.complete);
  for (const int threads : {2, 7}) {
    options.threads = threads;
    const RenderResult many = render_scene(scene, options);
    CHECK(identical(one.film, many.film));
    CHECK(one.counts.rays == many.counts.rays);
  }
}

TEST_CASE("Pictures do not depend on the accelerator") {
  Scene scene = room().scene;
  scene.render.samples = 2;
  CHECK(identical(render_scene(scene, {}, Answer::global_bvh).film,
                  render_scene(scene, {}, Answer::brute_force).film));
}

TEST_CASE("Pictures depend on the seed and not on the order of passes or crops") {
  Scene scene = room().scene;
  scene.film.width = 80;
  scene.render.samples = 5;
  const RenderResult whole = render_scene(scene);
  scene.film.crop = PixelRect{37, 61, 3, 29};
  const RenderResult part = render_scene(scene);
  bool equal = true;
  for (int y = 3; y < 29; ++y) {
    for (int x = 37; x < 61; ++x)
      equal = equal && whole.film.at(x, y).sum == part.film.at(x, y).sum;
  }
  CHECK(equal);
  scene.render.seed = 1;
  CHECK_FALSE(identical(part.film, render_scene(scene).film));
}

TEST_CASE("A stopped render keeps what it has") {
  Scene scene = room().scene;
  scene.render.samples = 1000000;
  std::atomic<bool> stop = false;
  RenderOptions options;
  options.stop = &stop;
  double last_fraction = 0;
  options.on_progress = [&](const Progress& progress) {
    CHECK(progress.fraction >= last_fraction);
    last_fraction = progress.fraction;
    if (progress.samples_finished >= 4) stop = true;
  };
  const RenderResult result = render_scene(scene, options);
  CHECK_FALSE(result.complete);
  CHECK(result.samples >= 4);
  CHECK(result.film.at(3, 3).samples >= 4);
}

TEST_CASE("A time limit ends a render after whole passes") {
  Scene scene = room().scene;
  scene.render.samples = 1000000;
  RenderOptions options;
  options.time_limit = 0.3;
  const RenderResult result = render_scene(scene, options);
  CHECK_FALSE(result.complete);
  CHECK(result.samples >= 1);
  CHECK(result.seconds < 3);
  for (const FilmPixel& pixel : result.film.pixels) {
    CHECK(pixel.samples + result.counts.nan_samples >= static_cast<unsigned>(result.samples));
  }
}

TEST_CASE("A time limit ends a render in the midst of a pass that takes longer than expected") {
  Scene scene = room().scene;
  scene.film.width = 160;
  scene.film.height = 128;
  scene.render.samples = 1000000;
  RenderOptions options;
  options.threads = 1;
  options.time_limit = 1;
  options.on_progress = [](const Progress& progress) {
    if (progress.samples_finished >= 1) std::this_thread::sleep_for(std::chrono::milliseconds(200));
  };
  const RenderResult result = render_scene(scene, options);
  CHECK_FALSE(result.complete);
  CHECK(result.seconds < 3);  // the pass would take 4
  CHECK(result.samples == 1);
  const double mean = mean_samples(result.film);
  CHECK(mean > 1);
  CHECK(mean < 2);
}
