// From triangles to what is traversed, by any heuristic.
#pragma once

#include <algorithm>

#include "bvh/build.hpp"
#include "bvh/bvh.hpp"

namespace pah {

// A BVH and the tree that it was collapsed from, by which its cost can be told.
struct BuiltBvh {
  Bvh bvh;
  BinaryTree tree;
};

// Over the triangles that `subset` names, which keep their indices.
template <typename Heuristic = SurfaceArea>
[[nodiscard]] BuiltBvh build_bvh_and_tree(const Triangles& triangles,
                                          std::span<const std::uint32_t> subset,
                                          BuildConfig config = {},
                                          const Heuristic& heuristic = {}) {
  config.max_leaf = std::min(config.max_leaf, ChildRef::max_leaf);
  std::vector<Aabb> boxes(subset.size());
  parallel_for(boxes.size(), detail::parallel_grain,
               [&](std::size_t i) { boxes[i] = triangles[subset[i]].bounds(); });
  BinaryTree tree = build_tree(std::span<const Aabb>(boxes), config, heuristic);
  std::vector<float> areas(tree.nodes.size());
  for (std::size_t i = 0; i < areas.size(); ++i) areas[i] = heuristic.area(tree.nodes[i].box);
  Bvh bvh = collapse(tree, areas, triangles, subset);
  return {std::move(bvh), std::move(tree)};
}

template <typename Heuristic = SurfaceArea>
[[nodiscard]] Bvh build_bvh(const Triangles& triangles, std::span<const std::uint32_t> subset,
                            const BuildConfig& config = {}, const Heuristic& heuristic = {}) {
  return build_bvh_and_tree(triangles, subset, config, heuristic).bvh;
}

}  // namespace pah
