// A light grid answers shadow rays by a look-up in place of a traversal. In the light's view every
// ray of its bundle is a point. A cell lists the blocks of the BVH's triangles that the light sees
// there, nearest first. A ray tests the blocks that are nearer to the light than its origin.
//
// Why no answer changes. Let u be the unit roundoff and M the largest distance along an axis from
// the ray's origin, or from the light, to a vertex. The shared rule (geometry/ray_triangle.hpp)
// accepts a hit only if the ray's point at t lies within 30 u M of the triangle along every axis.
// The rounding of the ray's direction, eye - origin, moves that point by at most u M off the exact
// line through the origin and the light. So this line, a point in the light's view, passes within
// 31 u M of the triangle.
//
// The look-up rounds as well. For a point light a tangent of at most 1 has 4 roundings, its
// distance of at most 2 from the face's corner has one, and that distance in tiles another: 8 u M.
// For a direction there are 5 roundings of three products that sum to at most sqrt(3)/2 M, and 2 of
// a distance of sqrt(3) M: 8 u M perpendicular to the rays.
//
// Rays to a sun with an angular size are tilted against its axis. Each is a segment in the light's
// view, which ends where the ray has risen to the nearest triangle around, and is looked up in all
// cells that it crosses (walk.cpp). The segment's end has 15 more roundings of its length in the
// view, which is at most the rise of at most sqrt(3) M: 34 u M in all. The depth at which the ray
// enters a cell has 5 roundings of the same.
//
// A cell lists every block with a triangle that the light sees within the sum of these errors
// (outline.hpp) of any point of the cell. Rays to which this does not apply, or that start where M
// would be larger, remain unknown.
#pragma once

#include <limits>
#include <pah/geometry/aabb.hpp>
#include <span>
#include <vector>

#include "bvh/bvh.hpp"
#include "light_space/light_view.hpp"

namespace pah {

// One face of the light's view. It is divided into square tiles, each of which is a grid of cells
// of its own: the more triangles it holds, the finer.
struct GridFace {
  float u = 0, v = 0;    // the first tile's corner
  float per_length = 0;  // tiles per unit of u and v
  std::uint32_t columns = 0, rows = 0;
  std::uint32_t first_tile = 0;
};

struct GridTile {
  std::uint32_t first_cell;
  std::uint32_t across;  // cells along each axis: a power of two, which adds no rounding
  // No ray that starts in this tile hits anything of less depth. Set for tilted rays only.
  float nearest = -std::numeric_limits<float>::infinity();
};

// A cell's list has three words per block: first the least depths of all blocks, ascending, as
// floats; then the ranges of places that they cover; then their numbers in the BVH.
struct GridCell {
  static constexpr std::uint32_t places = 128;  // along each axis
  static constexpr std::uint32_t unknown = 0xFFFFFFFFU;

  std::uint32_t first;  // the number of blocks in all lists before this one
  std::uint32_t count;  // the number of blocks, or `unknown`
};

// A rectangle of places in a cell, four bytes of seven bits. It contains another one (or a place)
// if none of its bytes is larger.
using PlaceBytes = std::uint32_t;
[[nodiscard]] constexpr PlaceBytes place_bytes(std::uint32_t first_u, std::uint32_t last_u,
                                               std::uint32_t first_v, std::uint32_t last_v) {
  constexpr std::uint32_t last = GridCell::places - 1;
  return first_u | (last - last_u) << 8U | first_v << 16U | (last - last_v) << 24U;
}
// With the eighth bits set in the minuend, one subtraction compares all bytes: none borrows from
// the next.
inline constexpr std::uint32_t eighth_bits = 0x80808080U;

// The box around the block's triangles.
[[nodiscard]] inline Aabb bounds_of(const TriangleBlock& block) {
  Aabb box;
  for (std::size_t lane = 0; lane < TriangleBlock::width; ++lane)
    box.extend(block.triangle(lane).bounds());
  return box;
}

class LightGrid {
 public:
  // Kernels read lists a vector at a time.
  static constexpr std::size_t read_beyond = 8;

  enum class Answer : std::uint8_t { free = 0, occluded = 1, unknown = 2 };

  // The calling arena's threads build it. The BVH must outlive the grid.
  LightGrid(const Bvh& over, const ExactBundle& bundle);

  // answers[i] tells whether ray i hits anything. It is `unknown` for rays that are not of the
  // bundle or start far from the triangles.
  void occluded(std::span<const Ray> rays, std::span<Answer> answers,
                TraversalCounts* counts) const;

  [[nodiscard]] std::uint64_t memory_bytes() const {
    return tiles.capacity() * sizeof(GridTile) + cells.capacity() * sizeof(GridCell) +
           lists.capacity() * sizeof(lists[0]) + near_blocks.capacity() * sizeof(near_blocks[0]);
  }

  // The kernels read these.
  const Bvh* bvh;
  std::variant<CubeView, ParallelView> view;
  Aabb origins;  // where rays may start
  std::array<GridFace, CubeView::faces> faces{};
  std::vector<GridTile> tiles;  // by face, row and column; the last stands for all that is outside
  std::vector<GridCell> cells;  // by tile, row and column
  std::vector<std::uint32_t> lists;
  std::vector<std::uint32_t> near_blocks;  // too near to the light to have a place on its faces
};

}  // namespace pah
