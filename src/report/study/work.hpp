// Counts the cost of rays in a tree.
#pragma once

#include <pah/geometry/triangles.hpp>
#include <span>
#include <vector>

#include "bvh/build.hpp"
#include "report/study/rays.hpp"

namespace pah {

// A tree for the study's traversal. Item i is triangle subset[i].
struct StudyTree {
  const BinaryTree& tree;
  Triangles triangles;
  std::span<const std::uint32_t> subset;
  std::uint32_t side_by_side = 4;
};

// A sum over many rays. A node costs its triangles if it is a leaf, else the boxes of its two
// children, as in expected_cost().
struct Tally {
  std::uint64_t rays = 0;
  std::uint64_t met = 0;   // rays that meet the root
  std::uint64_t hits = 0;  // rays that hit a triangle
  double cost = 0;
  double cost_squared = 0;

  void add(const Tally& other);
  // The mean over rays that meet the root; 0 without any.
  [[nodiscard]] double mean() const;
  [[nodiscard]] double standard_error() const;
  [[nodiscard]] double mean_of_all() const;
  [[nodiscard]] double hit_share() const;
};

// Counts every node that a ray meets within its region, whatever it hits. This is what a heuristic
// predicts. Does not count `hits`.
[[nodiscard]] Tally count_all(const StudyTree& tree, std::span<const BundleRay> rays);

// Counts the nodes that a search for the nearest hit visits, near child first; also beyond the
// region unless `within_region`.
[[nodiscard]] Tally count_closest(const StudyTree& tree, std::span<const BundleRay> rays,
                                  bool within_region = true);

// Returns the same cost by the renderer's kernels: one box cost for each node of up to eight
// children, one triangle cost for every `side_by_side` triangles.
[[nodiscard]] double kernel_cost(const Bvh& bvh, std::span<const BundleRay> rays,
                                 std::uint32_t side_by_side);

}  // namespace pah
