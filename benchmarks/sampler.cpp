// Points a second of the sample sequence.
#include "render/sampling/sampler.hpp"

#include <benchmark/benchmark.h>

#include "registrations.hpp"

namespace pah::bench {
namespace {

constexpr std::uint32_t samples = 64;     // of one pixel
constexpr std::uint32_t dimensions = 16;  // of each, about what a short path takes

// `draw` takes a sampler and gives a number whose mean is 0.5.
template <typename Draw>
void measure(benchmark::State& state, const Draw& draw) {
  float sum = 0;
  for (auto _ : state) {
    sum = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
      Sampler sampler(3, 5, i, 7);
      for (std::uint32_t k = 0; k < dimensions; ++k) sum += draw(sampler);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * samples * dimensions);
  state.counters["mean"] = static_cast<double>(sum) / (samples * dimensions);
}

}  // namespace

void register_sampler() {
  benchmark::RegisterBenchmark("sampler/1d", [](benchmark::State& state) {
    measure(state, [](Sampler& sampler) { return sampler.next_1d(); });
  });
  benchmark::RegisterBenchmark("sampler/2d", [](benchmark::State& state) {
    measure(state, [](Sampler& sampler) {
      const Vec2 point = sampler.next_2d();
      return 0.5F * (point.x + point.y);
    });
  });
}

}  // namespace pah::bench
