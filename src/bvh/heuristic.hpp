// What the builder asks of a heuristic. One indirect call measures many boxes, so that the builder
// is compiled once whatever the heuristic.
#pragma once

#include <functional>
#include <pah/bvh/build_config.hpp>
#include <span>

namespace pah {

// Writes the measure of each box: proportional to the chance that a ray hits it, only ratios
// matter. Whatever it writes for an empty box is not used. Called by several threads at a time.
using BoxMeasure = std::function<void(std::span<const Aabb>, std::span<float>)>;

// A measure from what has `area(box)`.
template <typename OneBox>
struct EachBox {
  OneBox one;

  void operator()(std::span<const Aabb> boxes, std::span<float> measures) const {
    for (std::size_t i = 0; i < boxes.size(); ++i) measures[i] = one.area(boxes[i]);
  }
};
template <typename OneBox>
[[nodiscard]] BoxMeasure each_box(OneBox one) {
  return EachBox<OneBox>{one};
}

[[nodiscard]] inline float measure_of(const BoxMeasure& measure, const Aabb& box) {
  float value = 0;
  measure(std::span(&box, 1), std::span(&value, 1));
  return value;
}

struct BuildHeuristic {
  BoxMeasure measure;
  std::function<AxisMask(const Aabb&)> axes;  // that may be split, of a node

  // The builder knows this measure itself.
  [[nodiscard]] bool by_area() const { return measure.target<EachBox<SurfaceArea>>() != nullptr; }
};

[[nodiscard]] inline AxisMask any_axis(const Aabb& /*box*/) { return all_axes; }
[[nodiscard]] AxisMask longest_axis(const Aabb& box);

// SAH: as if rays came from everywhere.
[[nodiscard]] inline BuildHeuristic surface_area_heuristic() {
  return {each_box(SurfaceArea{}), any_axis};
}

}  // namespace pah
