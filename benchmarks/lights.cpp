// Light samples a second of each kind of light, and choices a second among many.
#include "render/light/lights.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <pah/load/load_scene.hpp>
#include <pah/scene/shapes.hpp>

#include "registrations.hpp"
#include "render/sampling/sampler.hpp"

namespace pah::bench {
namespace {

constexpr double room = 8;   // the side of the floor, meters
constexpr double stage = 4;  // of the square that most spots of many_spots.yaml light

struct Draw {
  LitPoint at;
  float u;
  Vec2 u2;
};

// Points all over a square of the floor.
std::vector<Draw> draws(const World& world, double side) {
  std::vector<Draw> made;
  for (std::uint32_t i = 0; i < 1024; ++i) {
    Sampler sampler(0, 0, i, 1);
    const DVec2 at = side * (DVec2(sampler.next_2d()) - 0.5);
    Draw draw;
    draw.at = {Vec3(DVec3(at.x, 0, at.y) - world.origin), {0, 1, 0}, false};
    draw.u = sampler.next_1d();
    draw.u2 = sampler.next_2d();
    made.push_back(draw);
  }
  return made;
}

// A floor and a light; if it is an area light, that of a panel two meters above.
World world_with(const Light& light) {
  Scene scene;
  scene.materials.emplace_back();
  scene.textures = {ImageTexture{PAH_SOURCE_DIR "/scenes/textures/marble.png"}};
  scene.lights = {light};
  scene.meshes = {make_mesh(RectangleShape{{room, room}}), make_mesh(RectangleShape{{1, 1}})};
  scene.instances.emplace_back();
  if (std::holds_alternative<AreaLight>(light.model)) {
    const glm::dmat4x3 facing_down{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 2, 0}};
    scene.instances.push_back({1, 0, 0, facing_down});
  }
  return make_world(scene);
}

// `draw_one` takes a Draw and gives an optional.
template <typename DrawOne>
void measure(benchmark::State& state, const std::vector<Draw>& all, const DrawOne& draw_one) {
  for (auto _ : state) {
    for (const Draw& draw : all) {
      auto drawn = draw_one(draw);
      benchmark::DoNotOptimize(drawn);
    }
  }
  const auto lit =
      std::ranges::count_if(all, [&](const Draw& draw) { return draw_one(draw).has_value(); });
  const auto count = static_cast<std::int64_t>(all.size());
  state.SetItemsProcessed(state.iterations() * count);
  state.counters["lit_share"] = static_cast<double>(lit) / static_cast<double>(count);
}

void measure_sample(benchmark::State& state, const Light& light) {
  const World world = world_with(light);
  const Lights lights(world, TextureStore(world.textures));
  measure(state, draws(world, room), [&](const Draw& draw) {
    return lights.sample(0, draw.at, {draw.u, draw.u2});
  });
}

void measure_choice(benchmark::State& state, const std::string& scene_file) {
  const World world = make_world(load_scene(scene_file).scene);
  const Lights lights(world, TextureStore(world.textures));
  measure(state, draws(world, stage),
          [&](const Draw& draw) { return lights.sampler().choose(draw.at, draw.u); });
  state.counters["lights"] = static_cast<double>(lights.size());
}

}  // namespace

void register_lights() {
  const std::vector<Light> kinds{
      {"point", PointLight{{0, 3, 0}, Vec3{1}}},
      {"spot", SpotLight{{0, 3, 0}, {0, -1, 0}, Vec3{1}, 45, 0.15}},
      {"parallel", DirectionalLight{{-1, -2, -1}, Vec3{1}, 0}},
      {"sun", DirectionalLight{{-1, -2, -1}, Vec3{1}, 0.53}},
      {"area", AreaLight{}},
      {"environment", EnvironmentLight{}},
      {"environment_image", EnvironmentLight{Vec3{1}, 0}},
  };
  for (const Light& light : kinds) {
    benchmark::RegisterBenchmark(
        ("lights/sample/" + light.name).c_str(),
        [light](benchmark::State& state) { measure_sample(state, light); });
  }
  benchmark::RegisterBenchmark("lights/choose/many_spots", [](benchmark::State& state) {
    measure_choice(state, PAH_SOURCE_DIR "/scenes/many_spots.yaml");
  });
}

}  // namespace pah::bench
