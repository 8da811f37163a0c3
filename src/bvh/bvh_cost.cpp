#include "bvh/bvh_cost.hpp"

namespace pah {

double expected_cost(const Bvh& bvh, const BoxMeasure& measure, double whole) {
  if (bvh.nodes.empty()) return 0;
  double below_root = 0;
  for (const BvhNode& node : bvh.nodes) {
    for (std::size_t k = 0; k < BvhNode::width; ++k) {
      const Aabb box = node.box(k);
      if (box.empty()) continue;
      const ChildRef child = node.children[k];
      const float tests =
          child.is_leaf() ? leaf_cost(child.triangles(), TriangleBlock::width) : box_cost;
      below_root += double{tests} * double{measure_of(measure, box)};
    }
  }
  return double{box_cost} + (whole > 0 ? below_root / whole : 0);
}

}  // namespace pah
