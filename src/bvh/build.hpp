// The builder: top-down, binned (Wald, "On fast Construction of SAH-based Bounding Volume
// Hierarchies", 2007), parallel, and deterministic: the tree depends on the boxes alone, never on
// threads. A heuristic supplies only the measure of boxes and the axes to split.
#pragma once

#include <pah/bvh/binary_tree.hpp>
#include <pah/geometry/triangles.hpp>
#include <span>

#include "bvh/bvh.hpp"
#include "bvh/heuristic.hpp"

namespace pah {

// A tree over `boxes`; leaves name them by their position in the span. Throws
// std::length_error for 2^31 boxes or more.
[[nodiscard]] BinaryTree build_tree(std::span<const Aabb> boxes, const BuildConfig& config = {},
                                    const BuildHeuristic& heuristic = surface_area_heuristic());

// A BVH and the tree that it was collapsed from, by which its cost can be told.
struct BuiltBvh {
  Bvh bvh;
  BinaryTree tree;
};

// Over the triangles that `subset` names, which keep their indices. Throws std::length_error if
// they are too many: 2^26 leaves, say.
[[nodiscard]] BuiltBvh build_bvh(const Triangles& triangles, std::span<const std::uint32_t> subset,
                                 BuildConfig config = {},
                                 const BuildHeuristic& heuristic = surface_area_heuristic());

// Over all of them.
[[nodiscard]] BuiltBvh build_bvh(const Triangles& triangles);

}  // namespace pah
