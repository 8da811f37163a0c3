// Triangles a second from a scene to a BVH.
#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <functional>

#include "accel/local/build_local.hpp"
#include "meshes.hpp"
#include "registrations.hpp"

namespace pah::bench {
namespace {

constexpr int all_threads = tbb::task_arena::automatic;

void report(benchmark::State& state, std::uint64_t triangles, std::uint64_t bytes) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(triangles));
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["bytes_per_triangle"] =
      static_cast<double>(bytes) / static_cast<double>(triangles);
}

using Make = std::function<std::unique_ptr<Accelerator>(const Triangles&)>;

void measure_global(benchmark::State& state, const MeshScene& scene, const Make& make,
                    int threads) {
  tbb::task_arena arena(threads);
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    arena.execute([&] { bytes = make(scene.world.triangles())->memory().global_bvh; });
  }
  report(state, scene.world.triangles().size(), bytes);
}

void measure_local(benchmark::State& state, const MeshScene& scene, const LocalArea& area,
                   Heuristic heuristic) {
  LocalConfig config;
  config.heuristic = heuristic;
  config.split = SplitAxis::longest;
  tbb::task_arena arena(1);
  std::uint64_t triangles = 0, bytes = 0;
  for (auto _ : state) {
    arena.execute([&] {
      const BuiltLocalBvh local = build_local_bvh(scene.world.triangles(), area.area, config);
      triangles = local.triangles.subset.size();
      bytes = local.built.bvh.memory_bytes();
    });
  }
  report(state, triangles, bytes);
}

// By the clock: Embree's work is not all done on the calling thread, whatever the arena.
void add_global(const std::string& mesh, const std::string& maker, const Make& make) {
  const auto add = [&](const std::string& which, int threads) {
    benchmark::RegisterBenchmark(
        ("builds/" + maker + "/" + mesh + which).c_str(),
        [=](benchmark::State& state) { measure_global(state, mesh_scene(mesh), make, threads); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  add("/1_thread", 1);
  add("/all_threads", all_threads);
}

void add_globals(const std::string& mesh) {
  add_global(mesh, "global_sah", make_global_bvh);
  if (!has_embree()) return;
  add_global(mesh, "embree_medium", [](const Triangles& triangles) {
    return make_embree(triangles, EmbreeQuality::medium);
  });
}

void add_local(const std::string& mesh, const std::string& which, LightId light,
               Heuristic heuristic) {
  benchmark::RegisterBenchmark(("builds/" + which + "/" + mesh + "/1_thread").c_str(),
                               [=](benchmark::State& state) {
                                 const MeshScene& scene = mesh_scene(mesh);
                                 measure_local(state, scene, scene.areas[light], heuristic);
                               })
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_builds(const std::vector<std::string>& meshes) {
  add_globals(terrain);
  for (const std::string& mesh : meshes) {
    add_globals(mesh);
    add_local(mesh, "bulb_sah", MeshScene::bulb, Heuristic::surface_area);
    add_local(mesh, "bulb_pah", MeshScene::bulb, Heuristic::projected_area);
    add_local(mesh, "sun_pah", MeshScene::sun, Heuristic::projected_area);
  }
}

}  // namespace pah::bench
