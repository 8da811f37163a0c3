#include <tbb/parallel_for.h>

#include <numeric>

#include "accel/batch.hpp"
#include "bvh/build.hpp"
#include "bvh/bvh.hpp"

namespace pah {

namespace {

class GlobalBvh final : public Accelerator {
 public:
  explicit GlobalBvh(const Triangles& triangles) {
    std::vector<Aabb> boxes(triangles.size());
    tbb::parallel_for(std::size_t{0}, boxes.size(),
                      [&](std::size_t i) { boxes[i] = triangles[i].bounds(); });
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    bvh_ = Bvh(build_tree(std::span<const Aabb>(boxes)), triangles, all);
    bounds_ = bounds_of(triangles);
  }

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    with_counter(counts, [&](auto& counter) {
      closest_hits(rays, hits, bounds_, [&](const PreparedRay& ray, Hit& best) {
        pah::closest_hit(bvh_, ray, best, counter);
      });
    });
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    with_counter(counts, [&](auto& counter) {
      for (std::size_t i = 0; i < rays.size(); ++i) {
        results[i] = pah::occluded(bvh_, prepare(rays[i], bounds_), counter) ? 1 : 0;
      }
    });
  }

  [[nodiscard]] AcceleratorMemory memory() const override {
    return {.global_bvh = bvh_.memory_bytes()};
  }

 private:
  Bvh bvh_;
  Aabb bounds_;
};

}  // namespace

std::unique_ptr<Accelerator> make_global_bvh(Triangles triangles) {
  return std::make_unique<GlobalBvh>(triangles);
}

}  // namespace pah
