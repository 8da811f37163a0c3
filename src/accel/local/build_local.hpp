// Builds the local BVH of one influence area.
#pragma once

#include <pah/accel/local_bvhs.hpp>

#include "bvh/build.hpp"

namespace pah {

// An area's region, and the triangles that its rays can hit inside it.
struct LocalTriangles {
  Region region;
  float end_margin = 0;  // the largest distance by which a segment misses the eye it is aimed at
  std::vector<std::uint32_t> subset;
};

[[nodiscard]] LocalTriangles local_triangles(const Triangles& triangles, const InfluenceArea& area);

[[nodiscard]] BuiltBvh build_local(const Triangles& triangles,
                                   std::span<const std::uint32_t> subset, const InfluenceArea& area,
                                   const LocalConfig& config);

// A local BVH, its triangles and the time taken to build it.
struct BuiltLocalBvh {
  LocalTriangles triangles;
  BuiltBvh built;
  double seconds = 0;
};
[[nodiscard]] BuiltLocalBvh build_local_bvh(const Triangles& triangles, const InfluenceArea& area,
                                            const LocalConfig& config);

// The expected cost, in any BVH, of a ray of the area's bundle that passes through the whole
// region.
[[nodiscard]] double bundle_cost(const Bvh& bvh, const InfluenceArea& area);

}  // namespace pah
