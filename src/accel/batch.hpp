// What accelerators share: rays are prepared some at a time, so that they stay in the cache until
// they are traced, and kernels are chosen once for many.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "geometry/ray_box.hpp"

namespace pah {

inline constexpr std::size_t batch_size = 64;

// Calls `trace(prepared rays, first)` for successive runs of `rays`.
template <typename Trace>
void for_batches(std::span<const Ray> rays, const Trace& trace) {
  std::array<PreparedRay, batch_size> prepared;
  for (std::size_t first = 0; first < rays.size(); first += batch_size) {
    const std::size_t count = std::min(batch_size, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) prepared[i] = prepare(rays[first + i]);
    trace(std::span<const PreparedRay>(prepared.data(), count), first);
  }
}

// A search starts with no triangle at t_max and ends, if none is found, at infinity.
[[nodiscard]] inline Hit nothing_yet(const PreparedRay& ray) {
  Hit hit;
  hit.t = ray.t_max;
  return hit;
}

[[nodiscard]] inline Hit finished(const Hit& hit) { return hit.valid() ? hit : Hit{}; }

}  // namespace pah
