// A tree of five nodes whose measures are computed by hand.
#pragma once

#include <pah/bvh/binary_tree.hpp>

namespace pah::test {

// Half surface areas: the root 4 x 2 x 2 has 20. Its children meet in 1 x 2 x 2 (8), those of its
// left child, 2.5 x 2 x 2 (14), only in a 2 x 2 face (4).
//
//   0 [0, 4]           inner, depth 0
//   |- 1 [0, 2.5]      inner, depth 1
//   |  |- 3 [0, 1]     leaf of 2, depth 2
//   |  `- 4 [1, 2.5]   leaf of 5, depth 2
//   `- 2 [1.5, 4]      leaf of 3, depth 1
inline BinaryTree hand_made_tree() {
  const auto box = [](float from, float to) { return Aabb{{from, 0, 0}, {to, 2, 2}}; };
  BinaryTree tree;
  tree.nodes = {{box(0, 4), 1, 0},
                {box(0, 2.5F), 3, 0},
                {box(1.5F, 4), 7, 3},
                {box(0, 1), 0, 2},
                {box(1, 2.5F), 2, 5}};
  for (std::uint32_t i = 0; i < 10; ++i) tree.order.push_back(i);
  return tree;
}

}  // namespace pah::test
