// Measures of boxes. One indirect call measures many boxes, so that one compiled builder serves
// every measure.
#pragma once

#include <functional>
#include <pah/bvh/build_config.hpp>
#include <span>

namespace pah {

// Writes the measure of each box, which is proportional to the probability that a ray hits it: only
// ratios matter. The measure of an empty box is not used. Several threads call it at a time.
using BoxMeasure = std::function<void(std::span<const Aabb>, std::span<float>)>;

// A BoxMeasure made of a measure(box) for one box.
template <typename OneBox>
struct EachBox {
  OneBox one_box;

  void operator()(std::span<const Aabb> boxes, std::span<float> measures) const {
    for (std::size_t i = 0; i < boxes.size(); ++i) measures[i] = one_box(boxes[i]);
  }
};
template <typename OneBox>
[[nodiscard]] BoxMeasure each_box(OneBox one_box) {
  return EachBox<OneBox>{one_box};
}

[[nodiscard]] inline float measure_of(const BoxMeasure& measure, const Aabb& box) {
  float value = 0;
  measure(std::span(&box, 1), std::span(&value, 1));
  return value;
}

}  // namespace pah
