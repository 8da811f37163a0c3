// The BVH builder is top-down and binned (Wald, "On fast Construction of SAH-based Bounding Volume
// Hierarchies", 2007). It runs in parallel and is deterministic: the tree depends on the boxes
// alone, never on threads. A heuristic supplies only the measure of boxes and the axes to split.
#pragma once

#include <pah/bvh/binary_tree.hpp>
#include <pah/geometry/triangles.hpp>
#include <span>

#include "bvh/bvh.hpp"
#include "bvh/heuristic.hpp"

namespace pah {

// Builds a tree over `boxes`. Its leaves refer to boxes by their position in the span. Throws
// std::length_error for 2^31 boxes or more.
[[nodiscard]] BinaryTree build_tree(std::span<const Aabb> boxes, const BuildConfig& config = {},
                                    const BuildHeuristic& heuristic = surface_area_heuristic());

// A BVH and the binary tree that it was collapsed from.
struct BuiltBvh {
  Bvh bvh;
  BinaryTree tree;
};

// Builds a BVH over the triangles whose indices are in `subset`; hits report these indices. Throws
// std::length_error if it needs more than ChildRef::max_blocks blocks.
[[nodiscard]] BuiltBvh build_bvh(const Triangles& triangles, std::span<const std::uint32_t> subset,
                                 BuildConfig config = {},
                                 const BuildHeuristic& heuristic = surface_area_heuristic());

// Builds a BVH over all triangles.
[[nodiscard]] BuiltBvh build_bvh(const Triangles& triangles);

}  // namespace pah
