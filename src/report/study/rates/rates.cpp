#include "report/study/rates/rates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <pah/accel/light_grids.hpp>
#include <pah/render/acceleration.hpp>

#include "base/parallel_for.hpp"
#include "report/study/rates/answers.hpp"

namespace pah {
namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Kind {
  const char* name;
  RayBatches RecordedRays::*batches;
  RayQuery query;
};
constexpr std::array<Kind, 5> kinds{{
    {"camera nearest", &RecordedRays::camera, RayQuery::nearest},
    {"bounce nearest", &RecordedRays::bounce, RayQuery::nearest},
    {"bounce any", &RecordedRays::bounce, RayQuery::any},
    {"shadow any", &RecordedRays::shadow, RayQuery::any},
    {"shadow to a point or sun", &RecordedRays::shadow_to_point_or_sun, RayQuery::any},
}};

// Returns the seconds for tracing all batches `passes` times. Each recorded batch is one task and
// one call. On one thread this is CPU time, so that other programs do not count.
double time_of(const Accelerator& accelerator, RayQuery query, const RayBatches& batches,
               std::size_t passes, unsigned threads) {
  const std::size_t count = batches.ends.size();
  const auto part = [&](std::size_t first, std::size_t last) {
    // Kept between calls, as in the renderer.
    thread_local Answers answers;
    for (std::size_t i = first; i < last; ++i) {
      const std::span<const Ray> batch = batches.batch(i % count);
      answers.reserve(query, batch.size());
      ask(accelerator, query, batch, answers, 0);
    }
  };
  const clockid_t clock = threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
  const double start = seconds_of(clock);
  if (threads == 1) {
    part(0, count * passes);
  } else {
    parallel_ranges(count * passes, 1, part);
  }
  return seconds_of(clock) - start;
}

using Asked = std::vector<const NamedAccelerator*>;

Asked asked_for(RayQuery query, const std::vector<NamedAccelerator>& accelerators) {
  Asked asked;
  for (const NamedAccelerator& on : accelerators)
    if (query == RayQuery::any || on.nearest) asked.push_back(&on);
  return asked;
}

void measure_kind(const Kind& kind, const RayBatches& batches, unsigned threads, bool quick,
                  const Asked& accelerators, const std::vector<RateRow>& blank,
                  std::vector<RateRow>& rows) {
  // Many short turns, so that a slow phase of the machine affects all accelerators.
  constexpr unsigned turns = 5;
  const double turn_seconds = (quick ? 0.02 : 0.05) / turns;
  const unsigned repetitions = quick ? 3 : 5;
  std::vector<std::size_t> passes;
  for (const NamedAccelerator* on : accelerators) {
    const double warm_up = time_of(*on->accelerator, kind.query, batches, 1, threads);
    passes.push_back(static_cast<std::size_t>(
        std::clamp(std::ceil(turn_seconds / std::max(warm_up, 1e-9)), 1.0, 1e6)));
  }
  for (unsigned repetition = 1; repetition <= repetitions; ++repetition) {
    std::vector<double> took(accelerators.size());
    for (unsigned turn = 0; turn < turns; ++turn)
      for (std::size_t i = 0; i < accelerators.size(); ++i)
        took[i] += time_of(*accelerators[i]->accelerator, kind.query, batches, passes[i], threads);
    for (std::size_t i = 0; i < accelerators.size(); ++i) {
      RateRow row = blank[i];
      row.threads = threads;
      row.repetition = repetition;
      row.rays_per_second =
          static_cast<double>(batches.rays.size() * passes[i] * turns) / std::max(took[i], 1e-9);
      rows.push_back(row);
    }
  }
}

// Rows with the values that all repetitions share.
std::vector<RateRow> blank_rows(const std::string& scene, std::uint64_t triangles, const Kind& kind,
                                const RayBatches& batches, const Asked& accelerators) {
  const auto rays = static_cast<double>(batches.rays.size());
  std::vector<RateRow> rows;
  Answers expected;
  for (const NamedAccelerator* on : accelerators) {
    TraversalCounts counts;
    const Answers answers = ask_all(*on->accelerator, kind.query, batches, &counts);
    if (rows.empty()) expected = answers;
    RateRow row;
    row.scene = scene;
    row.triangles = triangles;
    row.ray_kind = kind.name;
    row.accelerator = on->name;
    row.batch = rays / static_cast<double>(batches.ends.size());
    if (on->counts) {
      row.nodes_per_ray = static_cast<double>(counts.nodes) / rays;
      row.triangles_per_ray = static_cast<double>(counts.triangles) / rays;
    }
    row.build_seconds = on->build_seconds;
    row.bytes = on->accelerator->memory().total();
    row.mismatches = count_mismatches(kind.query, expected, answers);
    rows.push_back(row);
  }
  return rows;
}

template <typename Make>
void add(std::vector<NamedAccelerator>& accelerators, const char* name, bool counts,
         const Make& make) {
  const double start = seconds_of(CLOCK_MONOTONIC);
  std::unique_ptr<Accelerator> made = make();
  accelerators.push_back({name, std::move(made), seconds_of(CLOCK_MONOTONIC) - start, counts});
}

bool builds_areas(const World& world, const Scene& settings) {
  return std::ranges::any_of(areas_of(world, settings.influence_areas, settings.film),
                             [](const SceneArea& area) { return plan(local_area(area)).build; });
}

std::vector<LightBundle> bundles_of(const World& world) {
  std::vector<LightBundle> bundles;
  for (std::size_t i = 0; i < world.lights.size(); ++i)
    if (const auto rays = exact_bundle(world.lights[i]))
      bundles.push_back({static_cast<std::uint32_t>(i), *rays});
  return bundles;
}

void add_embree(std::vector<NamedAccelerator>& accelerators, const Triangles& triangles) {
  add(accelerators, "embree", false, [&] { return make_embree(triangles); });
  add(accelerators, "embree16", false,
      [&] { return make_embree(triangles, EmbreeQuality::high, EmbreeRays::packets_of_16); });
  accelerators.back().nearest = false;
}

std::vector<NamedAccelerator> accelerators_of(const World& world, const Scene& settings) {
  std::vector<NamedAccelerator> all;
  add(all, "bvh", true, [&] { return make_global_bvh(world.triangles()); });
  if (builds_areas(world, settings))
    add(all, "local", true,
        [&] { return make_acceleration(world, settings, "local").accelerator; });
  if (const std::vector<LightBundle> bundles = bundles_of(world); !bundles.empty())
    add(all, "light", true, [&] { return make_light_grids(world.triangles(), bundles); });
  if (has_embree()) add_embree(all, world.triangles());
  return all;
}

}  // namespace

std::vector<RateRow> measure_rates(const std::string& scene, std::uint64_t triangles,
                                   const RecordedRays& rays,
                                   const std::vector<NamedAccelerator>& accelerators, bool quick) {
  std::vector<RateRow> rows;
  for (const Kind& kind : kinds) {
    const RayBatches& batches = rays.*kind.batches;
    if (batches.rays.empty()) continue;
    const Asked asked = asked_for(kind.query, accelerators);
    const std::vector<RateRow> blank = blank_rows(scene, triangles, kind, batches, asked);
    measure_kind(kind, batches, 1, quick, asked, blank, rows);
    if (parallel_threads() > 1)
      measure_kind(kind, batches, parallel_threads(), quick, asked, blank, rows);
  }
  return rows;
}

std::vector<RateRow> measure_rates(
    const std::vector<StudyScene>& scenes, const StudyConfig& config,
    const std::function<void(double, const std::string&)>& progress) {
  std::vector<RateRow> rows;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const StudyScene& scene = scenes[i];
    if (progress)
      progress(static_cast<double>(i) / static_cast<double>(scenes.size()),
               scene.name + ", rays a second");
    const Scene& settings = scene.settings;
    const std::uint64_t rays = config.quick ? 10'000 : 100'000;
    const std::vector<NamedAccelerator> accelerators = accelerators_of(scene.world, settings);
    const RecordedRays recorded = record_rays(scene.world, *accelerators.front().accelerator,
                                              settings.film, settings.render, rays, config.seed);
    const std::vector<RateRow> found =
        measure_rates(scene.name, scene.world.indices.size(), recorded, accelerators, config.quick);
    rows.insert(rows.end(), found.begin(), found.end());
  }
  return rows;
}

}  // namespace pah
