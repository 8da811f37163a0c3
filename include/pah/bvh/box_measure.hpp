// By what boxes are measured. One indirect call measures many, so that a builder is compiled once
// whatever the measure.
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

}  // namespace pah
