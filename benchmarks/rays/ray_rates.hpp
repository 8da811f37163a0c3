// How many rays a second an accelerator answers, on one thread.
#pragma once

#include <benchmark/benchmark.h>

#include "rays/recorded_rays.hpp"

namespace pah::bench {

enum class Query { nearest, any };
enum class Sent { in_batches, one_at_a_time };

void measure_rays(benchmark::State& state, const Accelerator& accelerator, Query query, Sent sent,
                  const RayBatches& batches);

}  // namespace pah::bench
