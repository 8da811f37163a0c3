// The local BVH of one influence area.
#pragma once

#include <pah/accel/local_bvhs.hpp>
#include <pah/influence/bundle_area.hpp>

#include "bvh/build_bvh.hpp"

namespace pah {

struct BuiltLocalBvh {
  BuiltBvh built;
  Region region;
  float end_margin = 0;         // by which a segment can miss the eye that it was aimed at
  std::uint64_t triangles = 0;  // that can be hit inside the region
  double seconds = 0;
};

// `bounds` holds all triangles.
[[nodiscard]] BuiltLocalBvh build_local_bvh(const Triangles& triangles, const Aabb& bounds,
                                            const InfluenceArea& area, const LocalConfig& config);

// Expected cost of a ray of the bundle, whether it meets the tree's root or not.
[[nodiscard]] double bundle_cost(const BinaryTree& tree, const BuildConfig& config,
                                 const HitProbability& probability);

}  // namespace pah
