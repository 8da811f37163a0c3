// The local BVH of one influence area.
#pragma once

#include <pah/accel/local_bvhs.hpp>

#include "bvh/build.hpp"

namespace pah {

// Where an area's rays live, and what they can hit there.
struct LocalTriangles {
  Region region;
  float end_margin = 0;  // by which a segment can miss the eye that it was aimed at
  std::vector<std::uint32_t> subset;
};

[[nodiscard]] LocalTriangles local_triangles(const Triangles& triangles, const InfluenceArea& area);

[[nodiscard]] BuiltBvh build_local(const Triangles& triangles,
                                   std::span<const std::uint32_t> subset, const InfluenceArea& area,
                                   const LocalConfig& config);

// Both, and how long it took.
struct BuiltLocalBvh {
  LocalTriangles triangles;
  BuiltBvh built;
  double seconds = 0;
};
[[nodiscard]] BuiltLocalBvh build_local_bvh(const Triangles& triangles, const InfluenceArea& area,
                                            const LocalConfig& config);

// Expected cost in any BVH of a ray of the area's bundle, all the way through its region.
[[nodiscard]] double bundle_cost(const Bvh& bvh, const InfluenceArea& area);

}  // namespace pah
