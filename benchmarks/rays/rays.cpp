// Rays a second, on one thread.
#include <array>

#include "generated_scenes.hpp"
#include "rays/ray_rates.hpp"
#include "rays/subjects.hpp"
#include "registrations.hpp"

namespace pah::bench {
namespace {

struct RayKind {
  const char* name;
  RayBatches RecordedRays::*batches;
  Query query;
};

constexpr std::array<RayKind, 3> general_kinds{{
    {"camera_nearest", &RecordedRays::camera, Query::nearest},
    {"bounce_nearest", &RecordedRays::bounce, Query::nearest},
    {"bounce_any", &RecordedRays::bounce, Query::any},
}};
constexpr std::array<RayKind, 3> shadow_kinds{{
    {"shadow_to_bulb", &RecordedRays::to_bulb, Query::any},
    {"shadow_to_sun", &RecordedRays::to_sun, Query::any},
    {"shadow_to_spot", &RecordedRays::to_spot, Query::any},
}};
constexpr std::array<const char*, 5> embree_at_its_best{
    "embree", "embree_packet8", "embree_packet16", "embree_sorted", "embree_sorted_packet16"};

void add(const RayKind& kind, Sent sent, const std::string& mesh, const std::string& accelerator) {
  const std::string how = sent == Sent::one_at_a_time ? "single_" : "";
  const std::string name = "rays/" + how + kind.name + "/" + mesh + "/" + accelerator;
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    Subject& on = subject(mesh);
    measure_rays(state, *on.built(accelerator).accelerator, kind.query, sent,
                 on.rays().*kind.batches);
  })->Unit(benchmark::kMillisecond);
}

void add_general(const std::string& mesh) {
  for (const RayKind& kind : general_kinds) {
    add(kind, Sent::in_batches, mesh, "bvh");
    if (has_embree()) add(kind, Sent::in_batches, mesh, "embree");
  }
}

// Only rays that go to a light have structures of their own, and orders, to be asked in.
void add_shadows(const std::string& mesh) {
  for (const RayKind& kind : shadow_kinds) {
    for (const Sent sent : {Sent::in_batches, Sent::one_at_a_time}) {
      add(kind, sent, mesh, "bvh");
      add(kind, sent, mesh, "light_grid");
    }
    const bool has_area = !is_generated(mesh) && kind.batches != &RecordedRays::to_spot;
    if (has_area) add(kind, Sent::in_batches, mesh, "local_pah");
    if (!has_embree()) continue;
    add(kind, Sent::one_at_a_time, mesh, "embree");
    for (const char* embree : embree_at_its_best) add(kind, Sent::in_batches, mesh, embree);
  }
}

}  // namespace

void register_rays(const std::vector<std::string>& meshes) {
  for (const std::string& mesh : meshes) {
    add_general(mesh);
    add_shadows(mesh);
  }
}

}  // namespace pah::bench
