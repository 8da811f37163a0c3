// A grid in the space of a light, where every ray of an exact bundle is a point: a look-up in place
// of a traversal. A cell lists the blocks of the BVH's triangles that the light sees there, the
// nearest first; a ray tests those that are nearer than its origin.
//
// Why no answer changes. The shared rule (geometry/ray_triangle.hpp) finds a triangle hit only if
// the ray's point at t lies within 30 u M of it along every axis, M being the largest distance
// along an axis from the ray's origin, or the light, to a vertex, u the unit roundoff. For a ray of
// the bundle that point is off the exact line through the origin and the light by u M at most: by
// the rounding of its direction, eye - origin. So the exact line, which the light sees as one
// point, passes the triangle within 31 u M.
//
// Looking up rounds, too, as if the point were seen a little off. For a point light a tangent, of
// at most 1, has 4 roundings, its distance from the face's corner, of at most 2, one, and that in
// tiles another: 8 u M. For a direction there are 5 roundings of three products of no more than
// sqrt(3)/2 M in all, and 2 of a distance of sqrt(3) M: 8 u M across the rays.
//
// Rays to a sun with a size lean against its axis. Each is a line in the light's view, as far as it
// rises to the nearest triangle around, and is looked up in all cells that it crosses (walk.cpp).
// Where it ends has 15 more roundings of that line's part along the view, which is no longer than
// its rise of at most sqrt(3) M: 34 u M in all. Its depth where it enters a cell has 5 of the same.
//
// A cell lists every block with a triangle that is seen within all of that (outline.hpp) of any of
// its points. Rays for which this does not hold, or that start where M would be larger, are not
// answered.
#pragma once

#include <limits>
#include <pah/geometry/aabb.hpp>
#include <span>
#include <vector>

#include "bvh/bvh.hpp"
#include "light_space/light_view.hpp"

namespace pah {

// One side of the light's view as square tiles, each of which is a grid of cells of its own, the
// finer the more triangles are in it.
struct GridFace {
  float u = 0, v = 0;    // of the first tile's corner
  float per_length = 0;  // tiles
  std::uint32_t columns = 0, rows = 0;
  std::uint32_t first_tile = 0;
};

struct GridTile {
  std::uint32_t first_cell;
  std::uint32_t across;  // cells, along each axis: a power of two, so that no rounding is added
  // No ray that starts here meets anything that is nearer. Of leaning rays only.
  float nearest = -std::numeric_limits<float>::infinity();
};

// A cell's list, three words a block: all blocks' least depths, ascending, as floats; then the
// places where something of them is seen; then their numbers.
struct GridCell {
  static constexpr std::uint32_t places = 128;  // along each axis
  static constexpr std::uint32_t unknown = 0xFFFFFFFFU;

  std::uint32_t first;  // the blocks in all lists before
  std::uint32_t count;  // of blocks, or `unknown`
};

// A rectangle of places in a cell, or a place: one of them holds another if none of its bytes is
// larger.
using PlaceBytes = std::uint32_t;
[[nodiscard]] constexpr PlaceBytes place_bytes(std::uint32_t first_u, std::uint32_t last_u,
                                               std::uint32_t first_v, std::uint32_t last_v) {
  constexpr std::uint32_t last = GridCell::places - 1;
  return first_u | (last - last_u) << 8U | first_v << 16U | (last - last_v) << 24U;
}
// Bytes have seven bits. With the eighth set none borrows from the next.
inline constexpr std::uint32_t eighth_bits = 0x80808080U;

// Of all its triangles.
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

  // The BVH must outlive the grid. Built by the calling arena's threads.
  LightGrid(const Bvh& over, const ExactBundle& bundle);

  // answers[i] tells whether ray i hits anything. Rays that are not of the bundle, or start far off
  // the triangles, remain unknown.
  void occluded(std::span<const Ray> rays, std::span<Answer> answers,
                TraversalCounts* counts) const;

  [[nodiscard]] std::uint64_t memory_bytes() const {
    return tiles.capacity() * sizeof(GridTile) + cells.capacity() * sizeof(GridCell) +
           lists.capacity() * sizeof(lists[0]) + near_blocks.capacity() * sizeof(near_blocks[0]);
  }

  // What the kernels look up.
  const Bvh* bvh;
  std::variant<CubeView, ParallelView> view;
  Aabb origins;  // where rays may start
  std::array<GridFace, CubeView::faces> faces{};
  std::vector<GridTile> tiles;  // by face, row and column; the last one is what is outside of them
  std::vector<GridCell> cells;  // by tile, row and column
  std::vector<std::uint32_t> lists;
  std::vector<std::uint32_t> near_blocks;  // too near to the light to have a place on its faces
};

}  // namespace pah
