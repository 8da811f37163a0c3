// A BVH laid out for traversal, and the traversal itself.
#pragma once

#include <pah/geometry/triangles.hpp>
#include <span>
#include <vector>

#include "bvh/binary_tree.hpp"
#include "geometry/ray_triangle.hpp"

namespace pah {

// A vertex copy per triangle, in leaf order, so that a leaf reads one run of memory.
struct LeafTriangle {
  Triangle triangle;
  std::uint32_t index;  // of the triangle in the scene
};

// An inner node: the boxes of both children, so that one cache line decides both.
struct alignas(64) BvhNode {
  // [axis] = {min of left, min of right, max of left, max of right}
  float planes[3][4];
  std::uint32_t first[2];  // leaf: of the triangles; inner node: its index
  std::uint32_t count[2];  // of triangles; 0 for an inner node
};
static_assert(sizeof(BvhNode) == 64);

class Bvh {
 public:
  Bvh() = default;
  // `subset`: which triangle of the scene the tree's item i is.
  Bvh(const BinaryTree& tree, const Triangles& triangles, std::span<const std::uint32_t> subset);

  [[nodiscard]] bool empty() const { return nodes_.empty(); }
  [[nodiscard]] std::span<const BvhNode> nodes() const { return nodes_; }
  [[nodiscard]] std::span<const LeafTriangle> triangles() const { return triangles_; }
  [[nodiscard]] std::uint64_t memory_bytes() const {
    return nodes_.capacity() * sizeof(BvhNode) + triangles_.capacity() * sizeof(LeafTriangle);
  }

 private:
  std::vector<BvhNode> nodes_;  // the root first; its right child is empty if the tree is one leaf
  std::vector<LeafTriangle> triangles_;
};

namespace detail {

// Visits what the ray's interval [0, limit()] meets, near children first. `leaf(first, count)`
// returns true to stop.
template <typename Limit, typename Leaf, typename Counter>
void traverse(std::span<const BvhNode> nodes, const PreparedRay& ray, const Limit& limit,
              const Leaf& leaf, Counter& counter) {
  struct Entry {
    std::uint32_t first;
    std::uint32_t count;
    float near;
  };
  if (nodes.empty()) return;
  Entry stack[max_depth + 1];
  int size = 0;
  Entry current{0, 0, 0};
  for (;;) {
    counter.node();
    bool descended = false;
    if (current.count > 0) {
      if (leaf(current.first, current.count)) return;
    } else {
      const BvhNode& node = nodes[current.first];
      float near[2] = {0, 0};
      float far[2] = {limit(), limit()};
      for (int axis = 0; axis < 3; ++axis) {
        const float* near_plane = node.planes[axis] + 2 * ray.negative[axis];
        const float* far_plane = node.planes[axis] + 2 - 2 * ray.negative[axis];
        for (int side = 0; side < 2; ++side) {
          near[side] =
              std::max(near[side], (near_plane[side] - ray.near_origin[axis]) * ray.inverse[axis]);
          far[side] =
              std::min(far[side], (far_plane[side] - ray.far_origin[axis]) * ray.inverse[axis]);
        }
      }
      const bool left = near[0] <= far[0];
      const bool right = near[1] <= far[1];
      if (left && right) {
        const int first = near[1] < near[0] ? 1 : 0;
        const int second = 1 - first;
        stack[size++] = {node.first[second], node.count[second], near[second]};
        current = {node.first[first], node.count[first], near[first]};
        descended = true;
      } else if (left || right) {
        const int side = left ? 0 : 1;
        current = {node.first[side], node.count[side], near[side]};
        descended = true;
      }
    }
    if (descended) continue;
    // Equal distance is visited: the lower index may win there.
    do {
      if (size == 0) return;
      current = stack[--size];
    } while (current.near > limit());
  }
}

}  // namespace detail

// The nearest of `best` and the BVH's triangles.
template <typename Counter>
void closest_hit(const Bvh& bvh, const PreparedRay& ray, Hit& best, Counter& counter) {
  detail::traverse(
      bvh.nodes(), ray, [&] { return best.t; },
      [&](std::uint32_t first, std::uint32_t count) {
        counter.triangles(count);
        for (const LeafTriangle& leaf : bvh.triangles().subspan(first, count)) {
          update_nearest(ray, leaf.triangle, leaf.index, best);
        }
        return false;
      },
      counter);
}

// Whether the ray hits any triangle.
template <typename Counter>
[[nodiscard]] bool occluded(const Bvh& bvh, const PreparedRay& ray, Counter& counter) {
  bool hit_any = false;
  detail::traverse(
      bvh.nodes(), ray, [&] { return ray.t_max; },
      [&](std::uint32_t first, std::uint32_t count) {
        counter.triangles(count);
        TriangleHit hit;
        for (const LeafTriangle& leaf : bvh.triangles().subspan(first, count)) {
          if (intersect_triangle(ray, leaf.triangle, ray.t_max, hit)) return hit_any = true;
        }
        return false;
      },
      counter);
  return hit_any;
}

}  // namespace pah
