// The BVH as rays traverse it: nodes of eight children and leaves of blocks of four triangles, both
// tested side by side.
//
// It is collapsed from a BinaryTree (Wald, Benthin and Boulos, "Getting Rid of Packets", RT 2008).
// Kernels are compiled for several instruction sets, and one is chosen at run time (traversal.cpp).
// All round the same way, so all give the same answers.
#pragma once

#include <array>
#include <pah/bvh/binary_tree.hpp>
#include <pah/bvh/build_config.hpp>
#include <pah/bvh/traversal_counts.hpp>
#include <pah/geometry/triangles.hpp>
#include <span>
#include <stdexcept>
#include <vector>

#include "geometry/ray_box.hpp"

namespace pah {

// A reference to a child: an inner node, or a leaf, which is a run of blocks.
class ChildRef {
 public:
  static constexpr std::uint32_t max_leaf = BuildConfig::most_leaf;  // triangles
  static constexpr std::uint32_t max_blocks = 1U << 26U;             // of four triangles

  ChildRef() = default;
  static ChildRef inner(std::uint32_t node) { return ChildRef(node); }
  // Throws std::length_error if the BVH has too many blocks.
  static ChildRef leaf(std::size_t first_block, std::uint32_t triangles) {
    if (first_block >= max_blocks)
      throw std::length_error("there are too many triangles for one BVH");
    return ChildRef(1U << 31U | static_cast<std::uint32_t>(first_block) << 5U | (triangles - 1));
  }
  [[nodiscard]] bool is_leaf() const { return bits_ >> 31U != 0; }
  [[nodiscard]] std::uint32_t node() const { return bits_; }
  [[nodiscard]] std::uint32_t first_block() const { return bits_ >> 5U & (max_blocks - 1); }
  [[nodiscard]] std::uint32_t triangles() const { return (bits_ & (max_leaf - 1)) + 1; }

 private:
  explicit ChildRef(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_;  // not initialized by default: traversal stacks hold hundreds
};

struct alignas(64) BvhNode {
  static constexpr std::size_t width = 8;
  float planes[3][2][width];  // [axis][min, max][child]; unused children have empty boxes
  ChildRef children[width];

  // The box of child k; empty if the child is not used.
  [[nodiscard]] Aabb box(std::size_t k) const {
    return {{planes[0][0][k], planes[1][0][k], planes[2][0][k]},
            {planes[0][1][k], planes[1][1][k], planes[2][1][k]}};
  }
};

struct alignas(16) TriangleBlock {
  static constexpr std::size_t width = 4;
  float vertices[3][3][width];  // [vertex][axis][triangle]; the last triangle fills a short block
  std::uint32_t indices[width];

  [[nodiscard]] Triangle triangle(std::size_t lane) const {
    const auto vertex = [&](std::size_t k) {
      return Vec3{vertices[k][0][lane], vertices[k][1][lane], vertices[k][2][lane]};
    };
    return {vertex(0), vertex(1), vertex(2)};
  }
};

struct Bvh {
  std::vector<BvhNode> nodes;  // the root first; empty if there are no triangles
  std::vector<TriangleBlock> blocks;

  [[nodiscard]] std::uint64_t memory_bytes() const {
    return nodes.capacity() * sizeof(BvhNode) + blocks.capacity() * sizeof(TriangleBlock);
  }
};

// Collapses a binary tree, whose leaves hold at most ChildRef::max_leaf triangles, to nodes of
// eight children. Item i of the tree is triangle subset[i] of the scene. `measures` has the measure
// of every node's box: the inner nodes of the largest measures are opened first.
[[nodiscard]] Bvh collapse(const BinaryTree& tree, std::span<const float> measures,
                           const Triangles& triangles, std::span<const std::uint32_t> subset);

// hits[i] becomes the nearest hit of ray i, or an invalid one.
void closest_hits(const Bvh& bvh, std::span<const Ray> rays, std::span<Hit> hits,
                  TraversalCounts* counts);

// results[i] becomes 1 if ray i hits anything, else 0.
void occluded(const Bvh& bvh, std::span<const Ray> rays, std::span<std::uint8_t> results,
              TraversalCounts* counts);

}  // namespace pah
