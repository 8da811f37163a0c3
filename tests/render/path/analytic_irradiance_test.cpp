// A white diffuse floor under one light reflects its irradiance over pi, which has a closed form.
// Each test takes a million samples, fewer under sanitizers.
#include <algorithm>
#include <pah/image/image_file.hpp>

#include "analytic_scenes.hpp"
#include "catch.hpp"
#include "support/fewer.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;
using namespace pah::test;

namespace {

// A floor seen at an angle, so that the camera does not block any light.
SceneBuilder floor_seen_from_aside(double scale = 1, DVec3 offset = DVec3(0)) {
  SceneBuilder builder(scale, offset);
  builder.add(RectangleShape{{4, 4}}, builder.diffuse(1));
  builder.look_parallel({1.5, 1, 0}, {0, 0, 0}, 1e-5, {0, 1, 0});
  builder.film(16, fewer_if_sanitized(4096));
  builder.scene.render.max_depth = 1;
  return builder;
}

void check_irradiance(const Scene& scene, double expected) {
  const RenderResult result = render_scene(scene);
  const Estimate e = estimate(result.film);
  INFO("mean " << e.mean * pi << " +- " << e.sigma * pi << ", expected " << expected);
  CHECK(e.samples >= fewer_if_sanitized(1'000'000));
  CHECK(result.counts.nan_samples == 0);
  CHECK(sigmas_off(e, expected / pi) < 4);
}

// The form factor from a point on a floor to a parallel rectangle at height h with one corner
// straight above and sides a, b (Howell, Catalog of Configuration Factors, B-4).
double corner_factor(double a, double b, double h) {
  const double x = a / h, y = b / h;
  return (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
          y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
         (2 * pi);
}

const std::array strategies{Strategy::mis, Strategy::nee, Strategy::bsdf};

}  // namespace

TEST_CASE("Irradiance under a point light agrees with the closed form") {
  SceneBuilder builder = floor_seen_from_aside();
  builder.light(PointLight{{0.3, 0.5, -0.2}, Vec3(3)});
  const double d2 = 0.09 + 0.25 + 0.04;
  check_irradiance(builder.scene, 3 / d2 * 0.5 / std::sqrt(d2));
}

TEST_CASE(
    "Irradiance under a spot agrees with the closed form inside, on the slope of and outside its "
    "cone") {
  for (const double tilt : {0.0, 17.0, 27.0, 40.0}) {
    SceneBuilder builder = floor_seen_from_aside();
    const double angle = glm::radians(tilt);
    builder.light(SpotLight{{0, 2, 0}, {std::sin(angle), -std::cos(angle), 0}, Vec3(3), 30, 0.5});
    const double inner = std::cos(glm::radians(15.0)), outer = std::cos(glm::radians(30.0));
    const double t = std::clamp((std::cos(angle) - outer) / (inner - outer), 0.0, 1.0);
    check_irradiance(builder.scene, 3.0 / 4 * t * t * (3 - 2 * t));
  }
}

TEST_CASE("Irradiance under parallel light and under a sun agrees with the closed form") {
  for (const double angle : {0.0, 0.53, 20.0}) {
    for (const Strategy strategy : strategies) {
      if (angle == 0.53 && strategy == Strategy::bsdf)
        continue;  // only some 20 samples would hit the sun
      SceneBuilder builder = floor_seen_from_aside();
      builder.light(DirectionalLight{{1, -2, 0.5}, Vec3(5), angle});
      builder.scene.render.strategy = strategy;
      check_irradiance(builder.scene, 5 * 2 / std::sqrt(5.25));
    }
  }
}

TEST_CASE("Irradiance under a rectangle agrees with the closed form") {
  for (const Strategy strategy : strategies) {
    for (const double height : {0.05, 1.0, 30.0}) {
      SceneBuilder builder = floor_seen_from_aside();
      // Light from a thin slot just above the floor would be in the camera's way: look from below
      // its plane.
      builder.look_parallel({3, std::min(1.0, 0.4 * height), 0}, {0, 0, 0}, 1e-5, {0, 1, 0});
      const LightId panel = builder.light(AreaLight{Vec3(2), false});
      builder.add(RectangleShape{{1, 2}}, 0, moved({0.1, height, 0.3}) * turned(180, {1, 0, 0}),
                  panel);
      builder.scene.render.strategy = strategy;
      if (height > 2 && strategy == Strategy::bsdf) continue;
      const double factor = corner_factor(0.6, 1.3, height) + corner_factor(0.4, 1.3, height) +
                            corner_factor(0.6, 0.7, height) + corner_factor(0.4, 0.7, height);
      INFO("height " << height << " strategy " << static_cast<int>(strategy));
      check_irradiance(builder.scene, 2 * pi * factor);
    }
  }
}

TEST_CASE("Irradiance under a rectangle whose image is half black agrees with the closed form") {
  const TemporaryFolder folder;
  Image image{256, 1, std::vector<Vec3>(256, Vec3(0))};
  std::fill(image.pixels.begin() + 128, image.pixels.end(), Vec3(0.5F));
  write_image(folder / "half.exr", {{"", {"R", "G", "B"}, image}});
  for (const Strategy strategy : strategies) {
    SceneBuilder builder = floor_seen_from_aside();
    ImageTexture texture;
    texture.file = folder / "half.exr";
    texture.clamp = true;
    builder.scene.textures.emplace_back(texture);
    const LightId panel = builder.light(AreaLight{Vec3(4), false, 0});
    builder.add(RectangleShape{{1, 2}}, 0, moved({0.1, 1, 0.3}) * turned(180, {1, 0, 0}), panel);
    builder.scene.render.strategy = strategy;
    const double factor = corner_factor(0.6, 1.3, 1) - corner_factor(0.1, 1.3, 1) +
                          corner_factor(0.6, 0.7, 1) - corner_factor(0.1, 0.7, 1);
    INFO("strategy " << static_cast<int>(strategy));
    check_irradiance(builder.scene, 2 * pi * factor);
  }
}

TEST_CASE("Irradiance under a disk of many triangles agrees with the closed form") {
  for (const Strategy strategy : strategies) {
    SceneBuilder builder = floor_seen_from_aside();
    const LightId disk = builder.light(AreaLight{Vec3(2), false});
    const int n = 256;
    builder.add(DiskShape{0.5, n}, 0, moved({0, 0.7, 0}) * turned(180, {1, 0, 0}), disk);
    builder.scene.render.strategy = strategy;
    // A regular polygon about the axis: n triangles, each seen by its far edge alone (Lambert's
    // formula; the other two edges lie in planes through the normal).
    const double r = 0.5, h = 0.7;
    const double apothem = r * std::cos(pi / n), half_edge = r * std::sin(pi / n);
    const double slant = std::sqrt(h * h + apothem * apothem);
    const double factor = n / pi * std::atan(half_edge / slant) * apothem / slant;
    check_irradiance(builder.scene, 2 * pi * factor);
  }
}

TEST_CASE("A two-sided panel lights both sides, a one-sided one its front only") {
  for (const bool two_sided : {false, true}) {
    SceneBuilder builder = floor_seen_from_aside();
    const LightId panel = builder.light(AreaLight{Vec3(2), two_sided});
    builder.add(RectangleShape{{1, 1}}, 0, moved({0, 1, 0}), panel);  // faces up
    const double factor = 4 * corner_factor(0.5, 0.5, 1);
    check_irradiance(builder.scene, two_sided ? 2 * pi * factor : 0);
  }
}

TEST_CASE("A lamp lying on a wall does not shade itself, nor does the wall leak") {
  // A panel on the wall x = -1 lights the floor; another light is behind the wall. Where panel and
  // wall are one plane, chance decides which of them a ray meets, so there it is asked for only.
  for (const double gap : {0.0, 1e-5}) {
    SceneBuilder builder = floor_seen_from_aside();
    builder.add(RectangleShape{{8, 8}}, 0, moved({-1 - gap, 0, 0}) * turned(-90, {0, 0, 1}));
    const LightId panel = builder.light(AreaLight{Vec3(2), false});
    builder.add(RectangleShape{{1, 1}}, 0, moved({-1, 0.5, 0}) * turned(-90, {0, 0, 1}), panel);
    builder.light(PointLight{{-1.001, 1, 0}, Vec3(100)});
    if (gap == 0) builder.scene.render.strategy = Strategy::nee;
    // A rectangle on a wall at right angles, its lower edge on the floor at a distance c, height a,
    // half-width b on either side (Howell, B-3).
    const double a = 1, b = 0.5, c = 1;
    const double ac = std::sqrt(a * a + c * c);
    const double factor = (std::atan(b / c) - c / ac * std::atan(b / ac)) / (2 * pi);
    INFO("gap " << gap);
    check_irradiance(builder.scene, 2 * pi * 2 * factor);
  }
}
