// Tests the choice among many lights, and their importances.
#include <numeric>
#include <pah/load/load_scene.hpp>

#include "analytic_scenes.hpp"
#include "catch.hpp"
#include "render/light/lights.hpp"
#include "render/sampling/sampler.hpp"
#include "support/paths.hpp"

using namespace pah;
using namespace pah::test;

namespace {

// Rings of 48 spots in a row over a bare floor, the middle ring around the origin. The beams cross:
// neighboring spots light distant places.
Scene spots_over_floor(int rings) {
  SceneBuilder builder;
  builder.add(RectangleShape{{12.0 * rings, 12}}, builder.diffuse(0.8F));
  for (int i = 0; i < 48 * rings; ++i) {
    Sampler sampler(0, 0, static_cast<std::uint32_t>(i), 1);
    const double around = 2 * pi * i / 48;
    const DVec3 center(12.0 * (i / 48) - 6.0 * (rings - 1), 0, 0);
    const DVec3 from = center + DVec3(5.2 * std::cos(around), 4.6, 5.2 * std::sin(around));
    const DVec2 aim = 4.0 * DVec2(sampler.next_2d()) - 2.0;
    const Vec3 intensity(5 + 20 * sampler.next_1d());
    builder.light(SpotLight{from, center + DVec3(aim.x, 0, aim.y) - from, intensity, 11, 0.25});
  }
  return builder.scene;
}

// Returns a random point of a rectangle on the floor around the origin.
LitPoint on_floor(const World& world, const DVec2& side, std::uint32_t index) {
  const DVec2 at = side * (DVec2(Sampler(0, 0, index, 2).next_2d()) - 0.5);
  return {Vec3(DVec3(at.x, 0, at.y) - world.origin), {0, 1, 0}, false};
}

LightBounds bounds_of(const SpotLight& spot, const World& world) {
  const double outer = glm::radians(spot.angle), inner = outer * (1 - spot.blend);
  LightBounds bounds;
  bounds.box.extend(Vec3(spot.position - world.origin));
  bounds.axis = Vec3(glm::normalize(spot.direction));
  bounds.cos_theta_o = static_cast<float>(std::cos(inner));
  bounds.cos_theta_e = static_cast<float>(std::cos(outer - inner));
  bounds.intensity = (spot.intensity.x + spot.intensity.y + spot.intensity.z) / 3;
  return bounds;
}

// Returns the variance of the irradiance estimated from one spot that the sampler draws, relative
// to drawing each spot in proportion to its own importance. Both variances are exact sums over the
// spots: of the squared irradiance of each spot over its probability.
double variance_over_exact(const Scene& scene, const DVec2& side) {
  const World world = make_world(scene);
  const Lights lights(world, TextureStore(world.textures));
  double drawn = 0, exact = 0;
  for (std::uint32_t point = 0; point < 1000; ++point) {
    const LitPoint at = on_floor(world, side, point);
    std::vector<double> importances;
    for (const Light& light : scene.lights) {
      importances.push_back(
          static_cast<double>(importance(bounds_of(std::get<SpotLight>(light.model), world), at)));
    }
    const double total = std::accumulate(importances.begin(), importances.end(), 0.0);
    double irradiance = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const auto id = static_cast<LightId>(i);
      const auto sample = lights.sample(id, at, {});
      if (!sample || sample->radiance.y == 0) continue;
      const auto sent = static_cast<double>(sample->radiance.y * sample->direction.y);
      const auto probability = static_cast<double>(lights.sampler().probability(at, id));
      REQUIRE(probability > 0);
      irradiance += sent;
      drawn += sent * sent / probability;
      exact += sent * sent * total / importances[i];
    }
    drawn -= irradiance * irradiance;
    exact -= irradiance * irradiance;
  }
  INFO("variance of the choice " << drawn << ", of the exact one " << exact);
  CHECK(exact > 0);
  return drawn / exact;
}

}  // namespace

TEST_CASE("The choice among many spots varies little more than one that weighs each spot") {
  CHECK(variance_over_exact(spots_over_floor(1), {12, 12}) < 1.5);
  CHECK(variance_over_exact(load_scene(source_folder() / "scenes/many_spots.yaml").scene, {9, 9}) <
        1.5);
  CHECK(variance_over_exact(spots_over_floor(2), {24, 12}) < 1.5);
  CHECK(variance_over_exact(spots_over_floor(5), {60, 12}) < 1.5);
  CHECK(variance_over_exact(spots_over_floor(20), {240, 12}) < 1.5);
}

TEST_CASE("Lights are weighed together with the same bits as alone, and never as NaN") {
  for (std::uint32_t trial = 0; trial < 2000; ++trial) {
    Sampler sampler(0, 0, trial, 3);
    const auto any_point = [&] {
      const Vec2 xy = sampler.next_2d();
      return 2.0F * Vec3(xy, sampler.next_1d()) - 1.0F;
    };
    const LitPoint at{any_point(), glm::normalize(any_point()), trial % 3 == 0};
    std::vector<LightBounds> bounds(1 + trial % 9);
    std::vector<float> packed(packed_size * bounds.size()), together(bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      bounds[i].box.extend(trial % 4 == 0 ? at.position : any_point());
      if (i % 2 == 0) bounds[i].box.extend(any_point());
      bounds[i].axis = glm::normalize(any_point());
      bounds[i].cos_theta_o = 2 * sampler.next_1d() - 1;
      bounds[i].cos_theta_e = 2 * sampler.next_1d() - 1;
      bounds[i].two_sided = i % 3 == 0;
      bounds[i].intensity = trial % 5 == 0 ? 1e38F : sampler.next_1d();
      pack(bounds[i], i, packed);
    }
    importances(packed, at, together.data());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      REQUIRE(together[i] == importance(bounds[i], at));
      REQUIRE(std::isfinite(together[i]));
    }
  }
}
