// The trees that BVHs are made of, to be looked at: see pah/bvh/analyze.hpp.
#pragma once

#include <pah/accel/local_bvhs.hpp>
#include <pah/bvh/binary_tree.hpp>

namespace pah {

// As make_global_bvh() builds it. Leaves name triangles by their indices.
[[nodiscard]] BinaryTree scene_tree(const Triangles& triangles);

// As make_local_bvhs() builds it for the area: over the triangles that its rays may hit, which
// leaves name by their indices among all.
[[nodiscard]] BinaryTree area_tree(const Triangles& triangles, const InfluenceArea& area,
                                   const LocalConfig& config = {});

// The part of an inner node of which rays of the area's bundle meet both children: the common area
// of their outlines, as the bundle sees them within the area, over that of the node (thesis, A.9
// and A.10). In [0, 1]; 0 if the node is not seen.
[[nodiscard]] double seen_overlap(const InfluenceArea& area, const Aabb& node, const Aabb& left,
                                  const Aabb& right);

}  // namespace pah
