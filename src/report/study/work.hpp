// Counts what rays cost in a tree.
#pragma once

#include <pah/geometry/triangles.hpp>
#include <span>
#include <vector>

#include "bvh/build.hpp"
#include "report/study/rays.hpp"

namespace pah {

// A tree as the study traverses it. Item i is triangle subset[i].
struct StudyTree {
  const BinaryTree& tree;
  Triangles triangles;
  std::span<const std::uint32_t> subset;
  std::uint32_t side_by_side = 4;
};

// Over many rays. A node's cost is that of expected_cost: a leaf's triangles, or the boxes of two
// children.
struct Tally {
  std::uint64_t rays = 0;
  std::uint64_t met = 0;   // rays that meet the root
  std::uint64_t hits = 0;  // rays that hit a triangle
  double cost = 0;
  double cost_squared = 0;

  void add(const Tally& other);
  // Of the rays that meet the root; 0 if there are none.
  [[nodiscard]] double mean() const;
  [[nodiscard]] double standard_error() const;
  [[nodiscard]] double mean_of_all() const;
  [[nodiscard]] double hit_share() const;
};

// Every node that a ray meets within its region, whatever it hits: what a heuristic predicts.
// `hits` is not counted.
[[nodiscard]] Tally count_all(const StudyTree& tree, std::span<const BundleRay> rays);

// The nodes that a search for the nearest hit visits, near child first. Beyond the region unless
// `within_region`.
[[nodiscard]] Tally count_closest(const StudyTree& tree, std::span<const BundleRay> rays,
                                  bool within_region = true);

// The same by the renderer's kernels: one box cost for each node of up to eight children, one
// triangle cost for every `side_by_side` triangles.
[[nodiscard]] double kernel_cost(const Bvh& bvh, std::span<const BundleRay> rays,
                                 std::uint32_t side_by_side);

}  // namespace pah
