// How rays a second, building and memory grow with the triangles of one scene.
#include "generated_scenes.hpp"
#include "rays/ray_rates.hpp"
#include "rays/subjects.hpp"
#include "registrations.hpp"

namespace pah::bench {
namespace {

std::vector<std::string> sizes() {
  std::vector<std::string> all{"10k", "30k", "100k", "300k", "1m"};
  if (large_scenes()) all.insert(all.end(), {"3m", "10m"});
  return all;
}

void measure(benchmark::State& state, const std::string& scene, const std::string& accelerator,
             RayBatches RecordedRays::*batches) {
  Subject& on = subject(scene);
  const BuiltAccelerator& built = on.built(accelerator);
  measure_rays(state, *built.accelerator, Query::any, Sent::in_batches, on.rays().*batches);
  const auto triangles = static_cast<double>(on.scene().world.triangles().size());
  const AcceleratorMemory memory = built.accelerator->memory();
  state.counters["triangles"] = triangles;
  state.counters["build_seconds"] = built.build_seconds;
  state.counters["bytes_per_triangle"] =
      static_cast<double>(memory.global_bvh + memory.light_grids) / triangles;
}

void add(const std::string& light, const std::string& scene, const std::string& accelerator,
         RayBatches RecordedRays::*batches) {
  benchmark::RegisterBenchmark(
      ("growth/" + light + "/" + scene + "/" + accelerator).c_str(),
      [=](benchmark::State& state) { measure(state, scene, accelerator, batches); })
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_growth() {
  std::vector<std::string> accelerators{"bvh", "light_grid"};
  if (has_embree()) accelerators.emplace_back("embree");
  for (const std::string& size : sizes()) {
    for (const std::string& accelerator : accelerators) {
      add("bulb", "forest_" + size, accelerator, &RecordedRays::to_bulb);
      add("sun", "forest_" + size, accelerator, &RecordedRays::to_sun);
    }
  }
}

}  // namespace pah::bench
