// What accelerators share: the loops over a batch, once with and once without counting.
#pragma once

#include <pah/accel/accelerator.hpp>

#include "geometry/ray_box.hpp"

namespace pah {

struct NoCounter {
  void node() {}
  void triangles(std::uint64_t) {}
};

struct TraversalCounter {
  TraversalCounts counts;
  void node() { ++counts.nodes; }
  void triangles(std::uint64_t n) { counts.triangles += n; }
};

// Calls `body(counter)` with a counter that costs nothing unless counts are asked for.
template <typename Body>
void with_counter(TraversalCounts* counts, const Body& body) {
  if (counts == nullptr) {
    NoCounter none;
    body(none);
    return;
  }
  TraversalCounter counter;
  body(counter);
  counts->nodes += counter.counts.nodes;
  counts->triangles += counter.counts.triangles;
}

// `nearest(prepared ray, best)` updates a Hit that starts as no triangle at t_max.
template <typename Nearest>
void closest_hits(std::span<const Ray> rays, std::span<Hit> hits, const Aabb& scene,
                  const Nearest& nearest) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const PreparedRay ray = prepare(rays[i], scene);
    Hit best;
    best.t = ray.t_max;
    nearest(ray, best);
    hits[i] = best.valid() ? best : Hit{};
  }
}

}  // namespace pah
