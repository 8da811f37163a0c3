// Intervals of real numbers, and rounding down.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace pah {

// A closed interval; empty when default-constructed.
struct Interval {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  [[nodiscard]] bool empty() const { return !(min <= max); }
  void extend(double x) {
    min = std::min(min, x);
    max = std::max(max, x);
  }
  void extend(const Interval& other) {
    min = std::min(min, other.min);
    max = std::max(max, other.max);
  }
};

[[nodiscard]] inline Interval common(const Interval& a, const Interval& b) {
  return {std::max(a.min, b.min), std::min(a.max, b.max)};
}

// The largest float that is not above x.
[[nodiscard]] inline float rounded_down(double x) {
  const auto rounded = static_cast<float>(x);
  return double{rounded} > x ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
                             : rounded;
}

}  // namespace pah
