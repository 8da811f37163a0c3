// How a BVH is built, and the cost model that builder, estimates and counters share.
//
// Trees are built with two children a node and traversed with eight (src/bvh/bvh.hpp). The builder
// and the study of trees as built (src/report/study) count box_cost for each of the two boxes of an
// inner node. Predicted, expected and measured costs are of the traversal: box_cost for each inner
// node visited, whose eight boxes are tested at once, and triangle_cost for each block of four
// triangles tested.
#pragma once

#include <cstdint>
#include <pah/bvh/traversal_counts.hpp>
#include <pah/geometry/aabb.hpp>

namespace pah {

// Expected cost of the two tests of a traversal, in units of the box test.
inline constexpr float box_cost = 1.0F;
inline constexpr float triangle_cost = 1.2F;  // of as many triangles as are tested side by side

// The cost of a leaf if `side_by_side` triangles are tested at a time.
[[nodiscard]] constexpr float leaf_cost(std::uint32_t triangles, std::uint32_t side_by_side) {
  const std::uint32_t rounds = (triangles + side_by_side - 1) / side_by_side;
  return triangle_cost * static_cast<float>(rounds);
}

[[nodiscard]] inline double traversal_cost(const TraversalCounts& counts) {
  return double{box_cost} * static_cast<double>(counts.inner_nodes) +
         double{triangle_cost} * static_cast<double>(counts.blocks);
}

// Bit i set: axis i may be split.
using AxisMask = std::uint32_t;
inline constexpr AxisMask all_axes = 0b111;

// By what the boxes of a BVH are measured.
enum class Heuristic : std::uint8_t {
  surface_area,    // SAH: as if rays came from everywhere
  projected_area,  // PAH: the chance that a ray of the area's bundle hits the box
  mean_direction  // PAH of a spread: the mean of the box's projected areas along the bundle's rays,
                  // as if each of these ran everywhere. Costs what SAH costs
};

// Which axes of a node may be split.
enum class SplitAxis : std::uint8_t {
  best,     // the cheapest split of all three
  longest,  // of the axis along which the node is longest
  facing    // SPFH: of the axes whose planes face the bundle's rays well enough
};

// SplitAxis::facing (thesis, algorithm 5.1). The ratio of a split is the sum of the chances of both
// halves to be hit over the node's: 1 if no ray meets both, 2 if all do.
struct FacingRules {
  double threshold = 0.5;       // axes of a lower facing quality are not split, but ...
  double acceptable_ratio = 2;  // ... if a split so far has no such ratio, the longest axis may be
  double excellent_ratio = 0;   // a split of at most this ends the search
};

struct SurfaceArea {
  // Half the surface area.
  [[nodiscard]] float area(const Aabb& box) const {
    const Vec3 size = box.extent();
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

// Nodes that become leaves before a split of them is sought, as far as leaves may be so large
// (thesis, 5.1). Where a rule is 0 there is none.
struct LeafRules {
  double cost = 0;         // less: the chance that a ray hits the node, times its cost as a leaf
  double area = 0;         // less m^2: of its surface, or of a bundle's cross-section that meets it
  double probability = 0;  // hit with less chance, in [0, 1], by a ray that the tree is for
  std::uint32_t triangles = 0;  // fewer
  std::uint32_t levels = 0;     // so many above it; larger nodes are halved from there on
};

struct BuildConfig {
  // Per axis, min_bins to max_bins: the borders between bins are the candidates for a split.
  static constexpr std::uint32_t min_bins = 2, max_bins = 64;
  std::uint32_t bins = 16;
  // Triangles, 1 to most_leaf: larger leaves are split whatever the cost.
  static constexpr std::uint32_t most_leaf = 32;
  std::uint32_t max_leaf = 8;
  // Triangles tested at a time, at least 1.
  std::uint32_t side_by_side = 4;
  // Of a node's triangles, that each child has at least, in [0, 0.5]: splits that would leave one
  // less are passed over, and a node without others is halved.
  double least_share = 0;
  LeafRules leaves;
};

}  // namespace pah
