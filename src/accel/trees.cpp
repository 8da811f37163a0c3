#include <algorithm>
#include <pah/accel/trees.hpp>

#include "accel/local/build_local.hpp"

namespace pah {

BinaryTree scene_tree(const Triangles& triangles) { return build_bvh(triangles).tree; }

BinaryTree area_tree(const Triangles& triangles, const InfluenceArea& area,
                     const LocalConfig& config) {
  BuiltLocalBvh local = build_local_bvh(triangles, area, config);
  for (std::uint32_t& item : local.built.tree.order) item = local.triangles.subset[item];
  return std::move(local.built.tree);
}

double seen_overlap(const InfluenceArea& area, const Aabb& node, const Aabb& left,
                    const Aabb& right) {
  const double whole = pah::area(projected_hull(area, node));
  if (!(whole > 0)) return 0;
  const double both = overlap_area(projected_hull(area, left), projected_hull(area, right));
  return std::min(1.0, both / whole);
}

}  // namespace pah
