#include <pah/accel/accelerator.hpp>

#include "geometry/ray_triangle.hpp"

namespace pah {

namespace {

// The padded boxes of four triangles, by axis.
struct BoxGroup {
  static constexpr std::size_t size = 4;
  Float4 min[3], max[3];
};

class BruteForce final : public Accelerator {
 public:
  explicit BruteForce(const Triangles& triangles) {
    triangles_.reserve(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) triangles_.push_back(triangles[i]);

    boxes_.resize((triangles.size() + BoxGroup::size - 1) / BoxGroup::size);
    for (std::size_t i = 0; i < boxes_.size() * BoxGroup::size; ++i) {
      const Aabb box = i < triangles.size() ? padded(triangles[i].bounds()) : Aabb{};
      for (int axis = 0; axis < 3; ++axis) {
        boxes_[i / BoxGroup::size].min[axis][i % BoxGroup::size] = box.min[axis];
        boxes_[i / BoxGroup::size].max[axis][i % BoxGroup::size] = box.max[axis];
      }
    }
  }

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const PreparedRay ray = prepare(rays[k]);
      Hit best = nothing_yet(ray.t_max);
      visit(ray, [&](std::size_t i) {
        update_nearest(ray, triangles_[i], static_cast<std::uint32_t>(i), best);
        return false;
      });
      hits[k] = finished(best);
      if (counts != nullptr) counts->triangles += triangles_.size();
    }
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const PreparedRay ray = prepare(rays[k]);
      std::size_t tests = triangles_.size();
      results[k] = 0;
      visit(ray, [&](std::size_t i) {
        TriangleHit hit;
        if (!intersect_triangle(ray, triangles_[i], ray.t_max, hit)) return false;
        tests = i + 1;
        results[k] = 1;
        return true;
      });
      if (counts != nullptr) counts->triangles += tests;
    }
  }

  [[nodiscard]] AcceleratorMemory memory() const override { return {}; }

 private:
  // Calls `test(i)` for every triangle whose padded box the ray meets, until it returns true.
  template <typename Test>
  void visit(const PreparedRay& ray, const Test& test) const {
    for (std::size_t group = 0; group < boxes_.size(); ++group) {
      const auto [near, far] = intersect_slabs(ray, boxes_[group].min, boxes_[group].max);
      const Int4 met = (near <= far) & (near <= ray.t_max);
      for (std::size_t i = 0; i < BoxGroup::size; ++i) {
        if (met[i] != 0 && test(group * BoxGroup::size + i)) return;
      }
    }
  }

  std::vector<Triangle> triangles_;
  std::vector<BoxGroup> boxes_;
};

}  // namespace

std::unique_ptr<Accelerator> make_brute_force(Triangles triangles) {
  return std::make_unique<BruteForce>(triangles);
}

}  // namespace pah
