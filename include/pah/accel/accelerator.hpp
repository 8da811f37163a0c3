// An Accelerator traces batches of rays. Batches hide latency, and the segments to one light use
// one structure.
//
// Every accelerator but Embree gives the same answers to the last bit: one shared test
// (src/geometry/ray_triangle.hpp) decides whether and where a ray hits a triangle.
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

// The memory of an accelerator's structures, in bytes.
struct AcceleratorMemory {
  std::uint64_t global_bvh = 0;
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

  // Sets hits[i] to the nearest hit of rays[i] with t <= t_max, or to an invalid Hit. Thread-safe.
  virtual void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                           TraversalCounts* counts = nullptr) const = 0;
  // Sets results[i] to 1 if rays[i] hits anything, else to 0. Thread-safe.
  virtual void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                        TraversalCounts* counts = nullptr) const = 0;

  [[nodiscard]] virtual AcceleratorMemory memory() const = 0;
};

// Makes the reference for tests, which tests every triangle. The triangles must outlive every
// accelerator made of them.
[[nodiscard]] std::unique_ptr<Accelerator> make_brute_force(Triangles triangles);

// Makes an accelerator of Embree, a reference for speed; null if pahrender was built without
// Embree. It has its own ray-triangle test, so its answers differ in the last bits, and it counts
// nothing. High quality splits triangles; medium is binned SAH, as pahrender's builder is. Packets
// are used for occlusion; nearest hits are searched for one ray at a time.
enum class EmbreeQuality : std::uint8_t { medium, high };
enum class EmbreeRays : std::uint8_t { single, packets_of_8, packets_of_16 };
[[nodiscard]] std::unique_ptr<Accelerator> make_embree(Triangles triangles,
                                                       EmbreeQuality quality = EmbreeQuality::high,
                                                       EmbreeRays rays = EmbreeRays::single);
[[nodiscard]] bool has_embree();

// Makes one BVH over all triangles by the surface area heuristic. The calling arena's threads build
// it.
[[nodiscard]] std::unique_ptr<Accelerator> make_global_bvh(Triangles triangles);

}  // namespace pah
