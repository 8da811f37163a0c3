// Bundles whose rays all run through one point or along one direction, or almost.
#pragma once

#include <pah/geometry/ray.hpp>
#include <variant>

namespace pah {

// Segments that end at `eye`: their direction is eye - origin, rounded, and t_max at most 1. They
// start within a cone about `axis`, of unit length, whose half-angle has a sine of `sine`, or
// anywhere if that is 1.
struct PointBundle {
  Vec3 eye{0};
  Vec3 axis{0, 0, 1};
  float sine = 1;
};

// Rays whose direction is `toward`, bit by bit, of unit length up to rounding; or, if `tangent` is
// not 0, any that differs from it by an angle of about that tangent at most, in [0, 1].
struct ParallelBundle {
  Vec3 toward{0, 1, 0};
  float tangent = 0;
};

using ExactBundle = std::variant<PointBundle, ParallelBundle>;

}  // namespace pah
