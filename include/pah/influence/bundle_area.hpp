// Measures of boxes for a bundle of rays, as builders use them.
#pragma once

#include <pah/influence/influence_area.hpp>
#include <span>

namespace pah {

// The mean of |d_k| over directions d, normalized: it replaces |d_k| where directions spread. Needs
// at least one direction, none of length 0.
[[nodiscard]] inline DVec3 mean_absolute_direction(std::span<const DVec3> directions) {
  DVec3 sum(0);
  for (const DVec3& d : directions) sum += glm::abs(glm::normalize(d));
  return sum / static_cast<double>(directions.size());
}

// The same over all rays of an area's bundle. For a point area it is a sum over the picture plane,
// accurate to 1e-3.
[[nodiscard]] DVec3 mean_absolute_direction(const InfluenceArea& area);

// The mean orthographic projected area of a box, in units of length^2, over one or many directions.
// As fast as a surface area; not clipped to any region.
class ParallelBundleArea {
 public:
  explicit ParallelBundleArea(const DVec3& mean_absolute) : weights_(mean_absolute) {}

  [[nodiscard]] float operator()(const Aabb& box) const {
    if (box.empty()) return 0;
    const DVec3 size = DVec3(box.max) - DVec3(box.min);
    return static_cast<float>(weights_.x * size.y * size.z + weights_.y * size.x * size.z +
                              weights_.z * size.x * size.y);
  }

 private:
  DVec3 weights_;
};

// The probability, in [0, 1], that a ray of the area's bundle meets a box within the region.
class HitProbability {
 public:
  explicit HitProbability(const InfluenceArea& area)
      : area_(area), scale_(1 / cross_section(area)) {}

  [[nodiscard]] float operator()(const Aabb& box) const {
    return static_cast<float>(projected_area(area_, box) * scale_);
  }

 private:
  InfluenceArea area_;
  double scale_;
};

}  // namespace pah
