// Indexed triangles, not owned: the geometry that accelerators work on.
#pragma once

#include <pah/geometry/aabb.hpp>
#include <span>

namespace pah {

struct Triangle {
  Vec3 a, b, c;

  [[nodiscard]] Aabb bounds() const {
    return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
  }
};

// Every index must be in range and every coordinate finite. Neither is checked.
struct Triangles {
  std::span<const Vec3> positions;
  std::span<const UVec3> indices;

  [[nodiscard]] std::size_t size() const { return indices.size(); }
  [[nodiscard]] Triangle operator[](std::size_t i) const {
    const UVec3& k = indices[i];
    return {positions[k.x], positions[k.y], positions[k.z]};
  }
};

// The box of all triangles; empty if there are none.
[[nodiscard]] Aabb bounds_of(const Triangles& triangles);

}  // namespace pah
