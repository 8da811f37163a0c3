// Bundles whose rays all run through one point, or along one direction up to a small angle.
#pragma once

#include <pah/geometry/ray.hpp>
#include <variant>

namespace pah {

// Segments that end at `eye`: their direction is eye - origin, rounded, and t_max at most 1. They
// start within a cone about the unit vector `axis` whose half-angle has the sine `sine`, or
// anywhere if `sine` is 1.
struct PointBundle {
  Vec3 eye{0};
  Vec3 axis{0, 0, 1};
  float sine = 1;
};

// Rays whose direction equals `toward`, of unit length up to rounding, to the last bit. If
// `tangent` is not 0, it is in [0, 1], and directions may differ from `toward` by an angle of at
// most about that tangent.
struct ParallelBundle {
  Vec3 toward{0, 1, 0};
  float tangent = 0;
};

using ExactBundle = std::variant<PointBundle, ParallelBundle>;

}  // namespace pah
