// What answers rays. The one virtual interface of the renderer; it takes batches, because batches
// are where speed comes from: latency hides, and segments to one light meet one structure.
//
// Every accelerator but Embree gives the same answers to the last bit: whether and where a ray
// meets a triangle is decided by one shared test (src/geometry/ray_triangle.hpp), whatever leads
// there.
#pragma once

#include <cstdint>
#include <memory>
#include <pah/bvh/traversal_counts.hpp>
#include <pah/geometry/ray.hpp>
#include <pah/geometry/triangles.hpp>
#include <span>
#include <string>
#include <vector>

namespace pah {

struct AcceleratorMemory {
  std::uint64_t global_bvh = 0;  // bytes
  std::uint64_t local_bvhs = 0;
  std::uint64_t light_grids = 0;
  std::uint64_t top_level = 0;

  [[nodiscard]] std::uint64_t total() const {
    return global_bvh + local_bvhs + light_grids + top_level;
  }
};

class Accelerator {
 public:
  virtual ~Accelerator() = default;
  Accelerator() = default;
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

  // hits[i] becomes the nearest hit of rays[i] with t <= t_max, or an invalid Hit. Thread-safe.
  virtual void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                           TraversalCounts* counts = nullptr) const = 0;
  // results[i] becomes 1 if anything is hit, else 0. Thread-safe.
  virtual void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                        TraversalCounts* counts = nullptr) const = 0;

  [[nodiscard]] virtual AcceleratorMemory memory() const = 0;
};

// Tests every triangle: the oracle. The triangles must outlive every accelerator made of them.
[[nodiscard]] std::unique_ptr<Accelerator> make_brute_force(Triangles triangles);

// Embree, as a peer to measure against: its ray-triangle test is its own, so that its answers are
// not the others' to the last bit, and it counts nothing. Null if this was built without Embree.
// High quality splits triangles; medium is binned SAH, as ours is. Packets are of rays searched for
// any hit; those searched for the nearest one are asked one at a time.
enum class EmbreeQuality : std::uint8_t { medium, high };
enum class EmbreeRays : std::uint8_t { single, packets_of_8, packets_of_16 };
[[nodiscard]] std::unique_ptr<Accelerator> make_embree(Triangles triangles,
                                                       EmbreeQuality quality = EmbreeQuality::high,
                                                       EmbreeRays rays = EmbreeRays::single);
[[nodiscard]] bool has_embree();

// One BVH over all triangles, by the surface area heuristic, built by the calling arena's threads.
[[nodiscard]] std::unique_ptr<Accelerator> make_global_bvh(Triangles triangles);

}  // namespace pah
