// Loops shared among the threads of the current arena. Whatever the number of threads, every part
// is done once and results are joined in order.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace pah {

// Threads of the current arena.
[[nodiscard]] unsigned parallel_threads();

// Calls body(first, last) for ranges of at most `grain` that together make [0, count). Returns when
// all are done; rethrows what one of them throws.
void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& body);

// Calls body(i) for each i below `count`. `grain` of them should be worth a task.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  parallel_ranges(count, grain, [&body](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) body(i);
  });
}

// Joins what `part(first, last)` makes of the chunks of [0, count), in their order, to `zero`:
// the same to the last bit on any number of threads.
template <typename Value, typename Part, typename Join>
[[nodiscard]] Value parallel_fold(std::size_t count, std::size_t chunk, const Value& zero,
                                  const Part& part, const Join& join) {
  std::vector<Value> parts((count + chunk - 1) / chunk, zero);
  parallel_for(parts.size(), 1, [&](std::size_t i) {
    parts[i] = part(i * chunk, i + 1 < parts.size() ? (i + 1) * chunk : count);
  });
  Value total = zero;
  for (const Value& value : parts) join(total, value);
  return total;
}

}  // namespace pah
