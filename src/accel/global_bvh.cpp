#include <pah/accel/accelerator.hpp>

#include "bvh/build.hpp"

namespace pah {

namespace {

class GlobalBvh final : public Accelerator {
 public:
  explicit GlobalBvh(const Triangles& triangles) : bvh_(build_bvh(triangles).bvh) {}

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    closest_hits(bvh_, rays, hits, counts);
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    pah::occluded(bvh_, rays, results, counts);
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
