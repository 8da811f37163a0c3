// Samples a second of whole small renders: what the other figures add up to.
#include <benchmark/benchmark.h>

#include <numeric>
#include <pah/load/load_scene.hpp>
#include <pah/render/render.hpp>

#include "registrations.hpp"

namespace pah::bench {
namespace {

double mean_of(const Image& image) {
  DVec3 sum(0);
  for (const Vec3& pixel : image.pixels) sum += DVec3(pixel);
  return (sum.x + sum.y + sum.z) / (3 * static_cast<double>(image.pixels.size()));
}

void measure(benchmark::State& state, const std::string& scene_name, int threads) {
  const LoadedScene loaded =
      load_scene(PAH_SOURCE_DIR "/scenes/" + scene_name + ".yaml",
                 {{"film.width=192", "film.height=192", "render.samples=8"}, {}});
  const World world = make_world(loaded.scene);
  const auto accelerator = make_global_bvh(world.triangles());
  RenderOptions options;
  options.threads = threads;
  RenderResult result;
  for (auto _ : state) {
    result = render(world, *accelerator, loaded.scene.film, loaded.scene.render, options);
  }
  const Image image = radiance_of(result.film);
  const auto samples =
      static_cast<std::int64_t>(image.pixels.size()) * std::int64_t{result.samples};
  const auto rays = static_cast<double>(
      std::accumulate(result.counts.rays.begin(), result.counts.rays.end(), std::uint64_t{0}));
  state.SetItemsProcessed(state.iterations() * samples);
  state.counters["rays_per_second"] =
      benchmark::Counter(rays, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["rays_per_sample"] = rays / static_cast<double>(samples);
  state.counters["mean_radiance"] = mean_of(image);
}

}  // namespace

void register_renders() {
  for (const std::string scene : {"cornell_box", "bust"}) {
    const auto add = [&](const std::string& which, int threads) {
      return benchmark::RegisterBenchmark(
                 ("renders/" + scene + which).c_str(),
                 [=](benchmark::State& state) { measure(state, scene, threads); })
          ->Unit(benchmark::kMillisecond);
    };
    add("/1_thread", 1);
    add("/all_threads", 0)->UseRealTime();
  }
}

}  // namespace pah::bench
