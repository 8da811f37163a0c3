// The parameters of a BVH build, and the cost model that builder, estimates and counters share.
//
// Trees are built with two children per node and traversed with eight (src/bvh/bvh.hpp). The
// builder and the study of trees as built (src/report/study) count box_cost for each of the two
// boxes of an inner node. Predicted, expected and measured costs are those of the traversal:
// box_cost for each inner node visited, whose eight boxes are tested at once, and triangle_cost for
// each block of four triangles tested.
#pragma once

#include <cstdint>
#include <pah/base/enum_names.hpp>
#include <pah/bvh/traversal_counts.hpp>
#include <pah/geometry/aabb.hpp>

namespace pah {

// The costs of the two tests of a traversal, in units of the box test.
inline constexpr float box_cost = 1.0F;
inline constexpr float triangle_cost = 1.2F;  // one block of triangles, tested side by side

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

// The measure of boxes that a builder minimizes.
enum class Heuristic : std::uint8_t {
  surface_area,    // SAH: assumes that rays come from everywhere
  projected_area,  // PAH: the probability that a ray of the area's bundle hits the box
  mean_direction  // the mean of the box's projected areas over the directions of the bundle's rays,
                  // not clipped to the area; as fast to compute as SAH
};
inline constexpr EnumName<Heuristic> heuristic_names[]{
    {Heuristic::surface_area, "sah", "SAH"},
    {Heuristic::projected_area, "pah", "PAH"},
    {Heuristic::mean_direction, "mean_direction", "mean direction"}};
[[nodiscard]] constexpr const char* label_of(Heuristic heuristic) {
  return label_of<Heuristic>(heuristic_names, heuristic);
}

// The axes of a node that may be split.
enum class SplitAxis : std::uint8_t {
  best,     // the cheapest split of all three
  longest,  // the cheapest split of the node's longest axis
  facing    // SPFH: the cheapest split of the axes whose planes face the bundle's rays well enough
};
inline constexpr EnumName<SplitAxis> split_axis_names[]{{SplitAxis::best, "auto", "best"},
                                                        {SplitAxis::longest, "longest", "longest"},
                                                        {SplitAxis::facing, "facing", "SPFH"}};
[[nodiscard]] constexpr const char* label_of(SplitAxis split) {
  return label_of<SplitAxis>(split_axis_names, split);
}

// The rules of SplitAxis::facing (thesis, algorithm 5.1). The ratio of a split is the sum of its
// halves' hit probabilities over the node's: 1 if no ray meets both halves, 2 if all rays do.
struct FacingRules {
  double threshold = 0.5;       // axes of a lower facing quality are not tried
  double acceptable_ratio = 2;  // the longest axis is tried if no split has at most this ratio
  double excellent_ratio = 0;   // a split of at most this ratio ends the search
};

// Half the surface area of a box.
struct SurfaceArea {
  [[nodiscard]] float operator()(const Aabb& box) const {
    const Vec3 size = box.extent();
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

// A node below one of these limits becomes a leaf without a search for a split, if max_leaf allows
// it (thesis, 5.1). A limit of 0 is off.
struct LeafRules {
  double cost = 0;         // the probability that a ray hits the node times its cost as a leaf
  double area = 0;         // m^2 of its surface, or of the bundle's cross-section that meets it
  double probability = 0;  // that a ray hits the node, in [0, 1]
  std::uint32_t triangles = 0;
  std::uint32_t levels = 0;  // nodes at this depth become leaves; too large ones are halved
};

struct BuildConfig {
  // The number of bins per axis. The borders between bins are the candidates for a split.
  static constexpr std::uint32_t min_bins = 2, max_bins = 64;
  std::uint32_t bins = 16;
  // The most triangles of a leaf, 1 to most_leaf: larger nodes are split at any cost.
  static constexpr std::uint32_t most_leaf = 32;
  std::uint32_t max_leaf = 8;
  // The number of triangles tested at a time, at least 1.
  std::uint32_t side_by_side = 4;
  // The least share of a node's triangles in each child, in [0, 0.5]. Splits that give a child less
  // are skipped; a node without other splits is halved.
  double least_share = 0;
  LeafRules leaves;
};

}  // namespace pah
