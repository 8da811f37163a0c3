#include "accel/build_local.hpp"

#include <algorithm>
#include <chrono>

#include "accel/bundle_heuristic.hpp"
#include "bvh/analyze.hpp"
#include "geometry/rounding.hpp"
#include "parallel/parallel_for.hpp"

namespace pah {

namespace {

// The largest number that coordinates and differences of coordinates in a box can have.
float magnitude_of(const Aabb& box) {
  const Vec3 size = glm::max(box.extent(), glm::max(glm::abs(box.min), glm::abs(box.max)));
  return std::max(size.x, std::max(size.y, size.z));
}

// With u the unit roundoff and M the magnitude above: a segment's end misses the eye it was aimed
// at by the rounding of the eye to float (u M), of the direction (2 u M), of the offset origin and
// of t_max (1 u M each).
constexpr int end_roundings = 5;
// Adds the padding of the slab test (11 u M and 2 u M, ray_box.hpp), the rounding of the interval's
// ends (3 u M) and that of the widened box (2 u M).
constexpr int margin_roundings = end_roundings + 18;

std::vector<std::uint32_t> triangles_near(const Triangles& triangles, const Region& region,
                                          float margin) {
  const RegionShape shape = shape_of(region);
  std::vector<std::uint8_t> near(triangles.size());
  parallel_for(near.size(), 4096, [&](std::size_t i) {
    const Aabb box = triangles[i].bounds();
    near[i] = overlaps(shape, Aabb{box.min - margin, box.max + margin}) ? 1 : 0;
  });
  std::vector<std::uint32_t> subset;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near[i] != 0) subset.push_back(static_cast<std::uint32_t>(i));
  }
  return subset;
}

}  // namespace

LocalTriangles local_triangles(const Triangles& triangles, const Aabb& bounds,
                               const InfluenceArea& area) {
  LocalTriangles local;
  local.region = region_of(area);
  Aabb reachable = bounds;
  reachable.extend(enclosing_box(local.region));
  const float magnitude = magnitude_of(reachable);
  local.end_margin = rounding_bound(end_roundings) * magnitude;
  local.subset =
      triangles_near(triangles, local.region, rounding_bound(margin_roundings) * magnitude);
  return local;
}

BuiltBvh build_local(const Triangles& triangles, std::span<const std::uint32_t> subset,
                     const InfluenceArea& area, const LocalConfig& config) {
  return build_bvh(triangles, subset, config.build, bundle_heuristic(area, config));
}

BuiltLocalBvh build_local_bvh(const Triangles& triangles, const Aabb& bounds,
                              const InfluenceArea& area, const LocalConfig& config) {
  const auto start = std::chrono::steady_clock::now();
  BuiltLocalBvh local;
  local.triangles = local_triangles(triangles, bounds, area);
  local.built = build_local(triangles, local.triangles.subset, area, config);
  local.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return local;
}

double bundle_cost(const BinaryTree& tree, const BuildConfig& config,
                   const HitProbability& probability) {
  if (tree.empty()) return 0;
  return expected_cost(tree, config, each_box(probability)) *
         double{probability.area(tree.nodes.front().box)};
}

}  // namespace pah
