// Loops that the threads of the current arena share. Results do not depend on the number of
// threads: each part runs once, and results are joined in order.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace pah {

// Returns the number of threads of the current arena.
[[nodiscard]] unsigned parallel_threads();

// Calls body(first, last) for ranges of at most `grain` indices that together make [0, count).
// Returns when all calls have ended; rethrows an exception of one of them.
void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& body);

// Calls body(i) for each i below `count`, with `grain` calls or fewer in a task.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  parallel_ranges(count, grain, [&body](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) body(i);
  });
}

// Calls part(first, last) for each chunk of [0, count), and joins the results to `zero` in order.
// The result is the same to the last bit on any number of threads.
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
