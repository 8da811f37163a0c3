#include <algorithm>
#include <array>
#include <pah/accel/accelerator.hpp>

#include "geometry/ray_triangle.hpp"

namespace pah {

namespace {

// The boxes of eight triangles, laid out so that the compiler vectorizes their tests.
struct BoxGroup {
  static constexpr std::size_t size = 8;
  std::array<std::array<std::array<float, size>, 2>, 3> planes;  // [axis][min, max][triangle]
};

class BruteForce final : public Accelerator {
 public:
  explicit BruteForce(const Triangles& triangles) {
    triangles_.reserve(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) triangles_.push_back(triangles[i]);

    boxes_.resize((triangles.size() + BoxGroup::size - 1) / BoxGroup::size);
    for (std::size_t i = 0; i < boxes_.size() * BoxGroup::size; ++i) {
      const Aabb box = i < triangles.size() ? padded(triangles[i].bounds()) : Aabb{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        auto& planes = boxes_[i / BoxGroup::size].planes[axis];
        planes[0][i % BoxGroup::size] = box.min[static_cast<int>(axis)];
        planes[1][i % BoxGroup::size] = box.max[static_cast<int>(axis)];
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
      std::array<float, BoxGroup::size> near{};
      std::array<float, BoxGroup::size> far;
      far.fill(ray.t_max);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int k = static_cast<int>(axis);
        const auto& planes = boxes_[group].planes[axis];
        const std::size_t near_side = std::signbit(ray.inverse[k]) ? 1 : 0;
        const std::size_t far_side = 1 - near_side;
        for (std::size_t i = 0; i < BoxGroup::size; ++i) {
          near[i] = std::max(near[i], planes[near_side][i] * ray.inverse[k] + ray.near_offset[k]);
          far[i] = std::min(far[i], planes[far_side][i] * ray.inverse[k] + ray.far_offset[k]);
        }
      }
      for (std::size_t i = 0; i < BoxGroup::size; ++i) {
        if (near[i] <= far[i] && test(group * BoxGroup::size + i)) return;
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
