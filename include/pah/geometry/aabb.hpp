// Axis-aligned boxes.
#pragma once

#include <limits>
#include <pah/geometry/vec.hpp>

namespace pah {

// A closed box. It is empty (min > max) when default-constructed, and grows by extend().
struct Aabb {
  Vec3 min{std::numeric_limits<float>::infinity()};
  Vec3 max{-std::numeric_limits<float>::infinity()};

  void extend(const Vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void extend(const Aabb& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  [[nodiscard]] bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  // The size along each axis; meaningless for an empty box.
  [[nodiscard]] Vec3 extent() const { return max - min; }
  // Halved before adding, so that it is finite for every finite box.
  [[nodiscard]] Vec3 center() const { return 0.5F * min + 0.5F * max; }
  // Corner i lies at the maximum of axis k if bit k of i is set.
  [[nodiscard]] Vec3 corner(unsigned i) const {
    return {(i & 1U) != 0 ? max.x : min.x, (i & 2U) != 0 ? max.y : min.y,
            (i & 4U) != 0 ? max.z : min.z};
  }

  friend bool operator==(const Aabb&, const Aabb&) = default;
};

}  // namespace pah
