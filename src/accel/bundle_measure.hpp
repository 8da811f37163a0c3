// Heuristics of the builder for the rays of one influence area.
#pragma once

#include <pah/accel/local_bvhs.hpp>
#include <pah/influence/bundle_area.hpp>
#include <pah/influence/facing.hpp>

namespace pah {

// The axes that SPFH admits for a node: those of enough facing quality, or else the best one.
class BundleAxes {
 public:
  BundleAxes(const InfluenceArea& area, LocalSplit split, double facing_threshold)
      : area_(area), split_(split), threshold_(facing_threshold) {}

  [[nodiscard]] AxisMask axes(const Aabb& box) const {
    if (split_ == LocalSplit::best) return all_axes;
    if (split_ == LocalSplit::longest) return SurfaceArea{AxisChoice::longest}.axes(box);
    const DVec3 direction = mean_direction(area_, box);
    const DVec3 quality = facing_quality(direction);
    AxisMask mask = 0;
    for (int k = 0; k < 3; ++k) {
      if (quality[k] >= threshold_ && box.max[k] > box.min[k]) mask |= 1U << k;
    }
    return mask != 0 ? mask : 1U << facing_axis_order(direction).front();
  }

 private:
  InfluenceArea area_;
  LocalSplit split_;
  double threshold_;
};

// SAH with a bundle's choice of axes.
struct LocalSurfaceArea {
  BundleAxes bundle;

  [[nodiscard]] float area(const Aabb& box) const { return SurfaceArea{}.area(box); }
  [[nodiscard]] AxisMask axes(const Aabb& box) const { return bundle.axes(box); }
};

// PAH: the share of the bundle's rays that meet the box.
struct LocalProjectedArea {
  BundleAxes bundle;
  HitProbability probability;

  [[nodiscard]] float area(const Aabb& box) const { return probability.area(box); }
  [[nodiscard]] AxisMask axes(const Aabb& box) const { return bundle.axes(box); }
};

}  // namespace pah
