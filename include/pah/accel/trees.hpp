// Builds the trees of BVHs for analysis: see pah/bvh/analyze.hpp.
#pragma once

#include <pah/accel/local_bvhs.hpp>
#include <pah/bvh/binary_tree.hpp>

namespace pah {

// The tree that make_global_bvh() builds. Leaves refer to triangles by their indices.
[[nodiscard]] BinaryTree scene_tree(const Triangles& triangles);

// The tree that make_local_bvhs() builds for an area. Leaves refer to triangles by their indices in
// `triangles`.
[[nodiscard]] BinaryTree area_tree(const Triangles& triangles, const InfluenceArea& area,
                                   const LocalConfig& config = {});

// The fraction, in [0, 1], of the rays through a node whose lines meet both children: the overlap
// of the children's outlines in the area's picture plane over the node's outline (thesis, A.9 and
// A.10). 0 if the bundle does not see the node.
[[nodiscard]] double seen_overlap(const InfluenceArea& area, const Aabb& node, const Aabb& left,
                                  const Aabb& right);

}  // namespace pah
