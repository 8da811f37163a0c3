// What a builder asks of a bundle of rays: a box in, a number out.
#pragma once

#include <pah/influence/influence_area.hpp>
#include <span>

namespace pah {

// The mean of |d_k| over unit directions: what replaces |d_k| where directions spread. Vectors of
// any length but 0; at least one.
[[nodiscard]] inline DVec3 mean_absolute_direction(std::span<const DVec3> directions) {
  DVec3 sum(0);
  for (const DVec3& d : directions) sum += glm::abs(glm::normalize(d));
  return sum / static_cast<double>(directions.size());
}

// The same of all rays of an area's bundle, by a sum over its picture plane: of a point area good
// to 1e-3.
[[nodiscard]] DVec3 mean_absolute_direction(const InfluenceArea& area);

// The expected orthographic area of a box, in units of length^2: of one direction's bundle, or the
// exact mean of many. Costs what a surface area costs; not clipped to any region.
class ParallelBundleArea {
 public:
  explicit ParallelBundleArea(const DVec3& mean_absolute) : weights_(mean_absolute) {}

  [[nodiscard]] float area(const Aabb& box) const {
    if (box.empty()) return 0;
    const DVec3 size = DVec3(box.max) - DVec3(box.min);
    return static_cast<float>(weights_.x * size.y * size.z + weights_.y * size.x * size.z +
                              weights_.z * size.x * size.y);
  }

 private:
  DVec3 weights_;
};

// The probability that a ray of the area's bundle meets a box, in [0, 1], clipped to the region.
class HitProbability {
 public:
  explicit HitProbability(const InfluenceArea& area)
      : area_(area), scale_(1 / cross_section(area)) {}

  [[nodiscard]] float area(const Aabb& box) const {
    return static_cast<float>(projected_area(area_, box) * scale_);
  }

 private:
  InfluenceArea area_;
  double scale_;
};

}  // namespace pah
