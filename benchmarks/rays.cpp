// Rays a second, on one thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <pah/accel/light_grids.hpp>

#include "recorded_rays.hpp"
#include "registrations.hpp"

namespace pah::bench {
namespace {

enum class Query { nearest, any };

struct RayKind {
  const char* name;
  RayBatches RecordedRays::*batches;
  Query query;
};

constexpr std::array<RayKind, 5> kinds{{
    {"camera_nearest", &RecordedRays::camera, Query::nearest},
    {"bounce_nearest", &RecordedRays::bounce, Query::nearest},
    {"bounce_any", &RecordedRays::bounce, Query::any},
    {"shadow_to_bulb", &RecordedRays::to_bulb, Query::any},
    {"shadow_to_sun", &RecordedRays::to_sun, Query::any},
}};

struct Subject {
  explicit Subject(const std::string& mesh) : scene(mesh_scene(mesh)), rays(record_rays(scene)) {}

  const MeshScene& scene;
  RecordedRays rays;
  std::unique_ptr<Accelerator> bvh = make_global_bvh(scene.world.triangles());
  std::unique_ptr<Accelerator> embree = make_embree(scene.world.triangles());
  std::unique_ptr<Accelerator> grids = make_light_grids(
      scene.world.triangles(), {{MeshScene::bulb, *exact_bundle(scene.world.lights[0])},
                                {MeshScene::sun, *exact_bundle(scene.world.lights[1])}});
  std::unique_ptr<Accelerator> local =
      make_local_bvhs(scene.world.triangles(), {scene.bulb_area, scene.sun_area},
                      {Heuristic::projected_area, SplitAxis::longest, 0.5, {}});
};

const Subject& subject(const std::string& mesh) {
  static std::map<std::string, Subject> kept;
  return kept.try_emplace(mesh, mesh).first->second;
}

struct Answers {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> occluded;

  explicit Answers(std::size_t rays) : hits(rays), occluded(rays) {}

  [[nodiscard]] std::size_t count(Query query, std::size_t rays) const {
    const auto n = static_cast<std::ptrdiff_t>(rays);
    return static_cast<std::size_t>(
        query == Query::nearest
            ? std::count_if(hits.begin(), hits.begin() + n, [](const Hit& h) { return h.valid(); })
            : std::count(occluded.begin(), occluded.begin() + n, 1));
  }
};

void ask(const Accelerator& accelerator, Query query, const std::vector<Ray>& rays,
         Answers& answers, TraversalCounts* counts = nullptr) {
  if (query == Query::nearest) {
    accelerator.closest_hit(rays, answers.hits, counts);
  } else {
    accelerator.occluded(rays, answers.occluded, counts);
  }
}

void measure(benchmark::State& state, const Accelerator& accelerator, Query query,
             const RayBatches& batches) {
  std::size_t rays = 0, longest = 0;
  for (const std::vector<Ray>& batch : batches) {
    rays += batch.size();
    longest = std::max(longest, batch.size());
  }
  Answers answers(longest);
  std::size_t hits = 0;
  TraversalCounts counts;
  for (const std::vector<Ray>& batch : batches) {
    ask(accelerator, query, batch, answers, &counts);
    hits += answers.count(query, batch.size());
  }
  for (auto _ : state) {
    for (const std::vector<Ray>& batch : batches) {
      ask(accelerator, query, batch, answers);
      benchmark::ClobberMemory();
    }
  }
  const auto all = static_cast<double>(rays);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays));
  state.counters["hit_share"] = static_cast<double>(hits) / all;
  state.counters["nodes_per_ray"] = static_cast<double>(counts.nodes) / all;
  state.counters["triangles_per_ray"] = static_cast<double>(counts.triangles) / all;
}

void add(const RayKind& kind, const std::string& mesh, const std::string& accelerator,
         std::unique_ptr<Accelerator> Subject::*which) {
  const std::string name = std::string("rays/") + kind.name + "/" + mesh + "/" + accelerator;
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const Subject& on = subject(mesh);
    measure(state, *(on.*which), kind.query, on.rays.*kind.batches);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_rays(const std::vector<std::string>& meshes) {
  for (const std::string& mesh : meshes) {
    for (const RayKind& kind : kinds) {
      add(kind, mesh, "bvh", &Subject::bvh);
      if (has_embree()) add(kind, mesh, "embree", &Subject::embree);
      // Only rays that go to a light have a structure of their own to be asked.
      const bool to_light =
          kind.batches == &RecordedRays::to_bulb || kind.batches == &RecordedRays::to_sun;
      if (!to_light) continue;
      add(kind, mesh, "local_pah", &Subject::local);
      add(kind, mesh, "light_grid", &Subject::grids);
    }
  }
}

}  // namespace pah::bench
