#include <algorithm>
#include <pah/accel/accelerator.hpp>

#include "accel/batch.hpp"
#include "bvh/build.hpp"

namespace pah {

namespace {

class GlobalBvh final : public Accelerator {
 public:
  explicit GlobalBvh(const Triangles& triangles) : bvh_(build_bvh(triangles).bvh) {}

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    for_batches(rays, [&](std::span<const PreparedRay> batch, std::size_t first) {
      const std::span<Hit> found = hits.subspan(first, batch.size());
      std::transform(batch.begin(), batch.end(), found.begin(), nothing_yet);
      closest_hits(bvh_, batch, found, counts);
      std::transform(found.begin(), found.end(), found.begin(), finished);
    });
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    std::fill_n(results.begin(), rays.size(), std::uint8_t{0});
    for_batches(rays, [&](std::span<const PreparedRay> batch, std::size_t first) {
      pah::occluded(bvh_, batch, results.subspan(first, batch.size()), counts);
    });
  }

  [[nodiscard]] AcceleratorMemory memory() const override {
    return {.global_bvh = bvh_.memory_bytes()};
  }

 private:
  Bvh bvh_;
};

}  // namespace

std::unique_ptr<Accelerator> make_global_bvh(Triangles triangles) {
  return std::make_unique<GlobalBvh>(triangles);
}

}  // namespace pah
