// Boxes in double precision, used before coordinates become float.
#pragma once

#include <cmath>
#include <pah/geometry/vec.hpp>

namespace pah {

struct Bounds {
  DVec3 min{HUGE_VAL};
  DVec3 max{-HUGE_VAL};

  void extend(const Bounds& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  // Halves before adding, so that the center of every finite box is finite.
  [[nodiscard]] DVec3 center() const { return 0.5 * min + 0.5 * max; }
};

}  // namespace pah
