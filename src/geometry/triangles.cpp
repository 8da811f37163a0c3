#include <pah/geometry/triangles.hpp>

namespace pah {

Aabb bounds_of(const Triangles& triangles) {
  Aabb bounds;
  for (std::size_t i = 0; i < triangles.size(); ++i) bounds.extend(triangles[i].bounds());
  return bounds;
}

}  // namespace pah
