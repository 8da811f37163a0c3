#include "rays/ray_rates.hpp"

#include <algorithm>

namespace pah::bench {
namespace {

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

void ask(const Accelerator& accelerator, Query query, Sent sent, std::span<const Ray> rays,
         Answers& answers, TraversalCounts* counts = nullptr) {
  const std::size_t size = sent == Sent::in_batches ? rays.size() : 1;
  for (std::size_t first = 0; first < rays.size(); first += size) {
    const auto asked = rays.subspan(first, size);
    if (query == Query::nearest) {
      accelerator.closest_hit(asked, std::span(answers.hits).subspan(first, size), counts);
    } else {
      accelerator.occluded(asked, std::span(answers.occluded).subspan(first, size), counts);
    }
  }
}

}  // namespace

void measure_rays(benchmark::State& state, const Accelerator& accelerator, Query query, Sent sent,
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
    ask(accelerator, query, sent, batch, answers, &counts);
    hits += answers.count(query, batch.size());
  }
  for (auto _ : state) {
    for (const std::vector<Ray>& batch : batches) {
      ask(accelerator, query, sent, batch, answers);
      benchmark::ClobberMemory();
    }
  }
  const auto all = static_cast<double>(rays);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays));
  state.counters["hit_share"] = static_cast<double>(hits) / all;
  state.counters["nodes_per_ray"] = static_cast<double>(counts.nodes) / all;
  state.counters["triangles_per_ray"] = static_cast<double>(counts.triangles) / all;
}

}  // namespace pah::bench
