#include "base/parallel_for.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "base/order.hpp"

namespace pah {

unsigned parallel_threads() {
  return static_cast<unsigned>(std::max(1, tbb::this_task_arena::max_concurrency()));
}

void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  ForkJoinOrder order;
  order.fork();
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(
      Range(0, count, grain),
      [&](const Range& range) {
        const ForkJoinOrder::Task task(order);
        body(range.begin(), range.end());
      },
      tbb::simple_partitioner());
}

}  // namespace pah
