#include "accel/local/build_local.hpp"

#include <algorithm>
#include <pah/influence/bundle_area.hpp>

#include "accel/local/bundle_heuristic.hpp"
#include "base/parallel_for.hpp"
#include "base/stopwatch.hpp"
#include "bvh/bvh_cost.hpp"
#include "geometry/rounding.hpp"

namespace pah {

namespace {

// Let u be the unit roundoff and M the largest absolute coordinate of the region and of a
// triangle's box. Differences of coordinates are at most 2 M. The end of a segment misses the eye
// at which it is aimed by the rounding of the eye to float (u M), of the direction (4 u M), of the
// offset origin (u M) and of t_max (2 u M).
constexpr int end_roundings = 8;
// Adds the distance of a hit from its triangle (30 u of up to 2 M, ray_triangle.hpp), the rounding
// of t where a ray leaves the region (6 u M), and the rounding of the widened box (2 u M).
constexpr int margin_roundings = end_roundings + 68;

std::vector<std::uint32_t> triangles_near(const Triangles& triangles, const Region& region,
                                          float magnitude) {
  const RegionShape shape = shape_of(region);
  std::vector<std::uint8_t> near(triangles.size());
  parallel_for(near.size(), 4096, [&](std::size_t i) {
    const Aabb box = triangles[i].bounds();
    const float margin = rounding_bound(margin_roundings) * std::max(magnitude, magnitude_of(box));
    near[i] = overlaps(shape, Aabb{box.min - margin, box.max + margin}) ? 1 : 0;
  });
  std::vector<std::uint32_t> subset;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near[i] != 0) subset.push_back(static_cast<std::uint32_t>(i));
  }
  return subset;
}

}  // namespace

LocalTriangles local_triangles(const Triangles& triangles, const InfluenceArea& area) {
  LocalTriangles local;
  local.region = region_of(area);
  const float magnitude = magnitude_of(enclosing_box(local.region));
  local.end_margin = rounding_bound(end_roundings) * magnitude;
  local.subset = triangles_near(triangles, local.region, magnitude);
  return local;
}

BuiltBvh build_local(const Triangles& triangles, std::span<const std::uint32_t> subset,
                     const InfluenceArea& area, const LocalConfig& config) {
  return build_bvh(triangles, subset, config.build, bundle_heuristic(area, config));
}

BuiltLocalBvh build_local_bvh(const Triangles& triangles, const InfluenceArea& area,
                              const LocalConfig& config) {
  const Stopwatch stopwatch;
  BuiltLocalBvh local;
  local.triangles = local_triangles(triangles, area);
  local.built = build_local(triangles, local.triangles.subset, area, config);
  local.seconds = stopwatch.seconds();
  return local;
}

double bundle_cost(const Bvh& bvh, const InfluenceArea& area) {
  return expected_cost(bvh, each_box(HitProbability(area)), 1);
}

}  // namespace pah
