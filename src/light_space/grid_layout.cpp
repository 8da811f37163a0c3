#include "light_space/grid_layout.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "base/parallel_for.hpp"
#include "light_space/outline.hpp"

namespace pah {

namespace {

// So many tiles that triangles are of similar size within most of them, so few that they fit in the
// caches.
constexpr double triangles_per_tile = 16;
constexpr double most_tiles_across = 8192;
constexpr std::uint32_t most_cells_across = 256;

struct FaceExtent {
  Interval u, v;

  [[nodiscard]] bool empty() const { return u.empty() || v.empty(); }
  [[nodiscard]] double size() const { return empty() ? 0 : (u.max - u.min) * (v.max - v.min); }
};

std::array<DVec3, 8> corners_on(const auto& view, int face, const Aabb& box) {
  std::array<DVec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i) corners[i] = view.local(face, DVec3(box.corner(i)));
  return corners;
}

// The part of a face that sees the box of all rays' origins, or a little more.
FaceExtent extent_on(const ParallelView& view, int face, const Aabb& box, double /*error*/) {
  FaceExtent extent;
  for (const DVec3& corner : corners_on(view, face, box)) {
    extent.u.extend(corner.x);
    extent.v.extend(corner.y);
  }
  return extent;
}
FaceExtent extent_on(const CubeView& view, int face, const Aabb& box, double error) {
  const auto corners = corners_on(view, face, box);
  Interval depth;
  for (const DVec3& corner : corners) depth.extend(corner.z);
  if (depth.max <= 0) return {};
  const FaceExtent all{view.limits(face, 0), view.limits(face, 1)};
  if (depth.min < nearest_on_faces * error) return all;
  FaceExtent seen;
  for (const DVec3& corner : corners) {
    seen.u.extend(corner.x / corner.z);
    seen.v.extend(corner.y / corner.z);
  }
  const double margin = margin_at(depth.min, error);
  return {common({seen.u.min - margin, seen.u.max + margin}, all.u),
          common({seen.v.min - margin, seen.v.max + margin}, all.v)};
}

// The face that sees a point, and the point's place on it.
struct PlaceOnFace {
  std::size_t face;
  DVec2 at;
};
PlaceOnFace place_on_face(const ParallelView& view, const DVec3& point) {
  return {0, DVec2(view.local(0, point))};
}
PlaceOnFace place_on_face(const CubeView& view, const DVec3& point) {
  const DVec3 away = glm::abs(point - DVec3(view.eye()));
  const int axis = away.x >= away.y && away.x >= away.z ? 0 : away.y >= away.z ? 1 : 2;
  const int face = point[axis] < double{view.eye()[axis]} ? axis + 3 : axis;
  const DVec3 local = view.local(face, point);
  return {static_cast<std::size_t>(face), DVec2(local) / local.z};
}

// One of the 8 x 8 parts of a tile. The last tile stands for everything outside the faces.
struct TilePart {
  std::size_t tile;
  unsigned part = 0;
};
TilePart tile_part_of(const LightGrid& grid, const PlaceOnFace& point) {
  const GridFace& face = grid.faces[point.face];
  const DVec2 at = (point.at - DVec2(face.u, face.v)) * double{face.per_length};
  if (!(at.x >= 0 && at.y >= 0 && at.x < face.columns && at.y < face.rows))
    return {grid.tiles.size() - 1};
  const DVec2 tile = glm::floor(at), within = 8.0 * (at - tile);
  return {face.first_tile + static_cast<std::size_t>(tile.y) * face.columns +
              static_cast<std::size_t>(tile.x),
          8 * static_cast<unsigned>(within.y) + static_cast<unsigned>(within.x)};
}

void lay_out_tiles(LightGrid& grid, std::span<const FaceExtent> extents, double tiles) {
  double total = 0;
  for (const FaceExtent& extent : extents) total += extent.size();
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < extents.size(); ++i) {
    GridFace& face = grid.faces[i];
    face = {};
    if (extents[i].empty()) continue;
    face.u = rounded_down(extents[i].u.min);
    face.v = rounded_down(extents[i].v.min);
    const double width = extents[i].u.max - double{face.u};
    const double height = extents[i].v.max - double{face.v};
    const double most = most_tiles_across / std::max(width, height);
    // Infinite where the extent is a point: one tile then.
    const auto per_length = static_cast<float>(std::min(std::sqrt(tiles / total), most));
    face.per_length = std::isfinite(per_length) ? per_length : 1;
    const auto across = [&](double length) {
      return static_cast<std::uint32_t>(length * double{face.per_length}) + 1;
    };
    face.columns = across(width);
    face.rows = across(height);
    face.first_tile = count;
    count += face.columns * face.rows;
  }
  grid.tiles.assign(count + std::size_t{1}, {0, 1});
}

// The blocks whose centers a tile holds.
struct TileContent {
  std::atomic<std::uint32_t> blocks = 0;
  std::atomic<std::uint64_t> parts = 0;  // bit i: part i holds a center
};

template <typename View>
std::vector<TileContent> contents(const LightGrid& grid, const View& view) {
  std::vector<TileContent> of(grid.tiles.size());
  parallel_for(grid.bvh->blocks.size(), 4096, [&](std::size_t i) {
    const DVec3 middle(bounds_of(grid.bvh->blocks[i]).center());
    const TilePart at = tile_part_of(grid, place_on_face(view, middle));
    of[at.tile].blocks.fetch_add(1, std::memory_order_relaxed);
    of[at.tile].parts.fetch_or(1ULL << at.part, std::memory_order_relaxed);
  });
  return of;
}

// `density` cells per triangle over the occupied parts of the tile, so that a small dense object
// gets cells of its size. A few blocks do not show which parts are occupied. A lower bound on these
// keeps empty cells from taking more memory than the lists.
double cells_wanted(const TileContent& content, double density) {
  constexpr std::uint32_t many_blocks = 256;
  constexpr int fewest_parts = 4;
  const std::uint32_t blocks = content.blocks;
  const double cells = density * static_cast<double>(TriangleBlock::width * blocks);
  if (blocks < many_blocks) return cells;
  return cells * 64 / std::max(std::popcount(content.parts.load()), fewest_parts);
}

// The power of two whose square is nearest to `cells` by ratio.
std::uint32_t cells_across(double cells) {
  const double across = std::sqrt(std::max(2 * cells, 1.0));
  return std::min(std::bit_floor(static_cast<std::uint32_t>(across)), most_cells_across);
}

template <typename View>
void lay_out(LightGrid& grid, const View& view, double density, double error) {
  std::array<FaceExtent, CubeView::faces> extents;
  for (int face = 0; face < View::faces; ++face)
    extents[static_cast<std::size_t>(face)] = extent_on(view, face, grid.origins, error);
  const auto triangles = static_cast<double>(TriangleBlock::width * grid.bvh->blocks.size());
  lay_out_tiles(grid, extents, density * triangles / triangles_per_tile);
  const std::vector<TileContent> content = contents(grid, view);
  std::uint32_t cells = 0;
  for (std::size_t i = 0; i < grid.tiles.size(); ++i) {
    const bool outside = i + 1 == grid.tiles.size();
    const std::uint32_t across = outside ? 1 : cells_across(cells_wanted(content[i], density));
    grid.tiles[i] = {cells, across};
    cells += across * across;
  }
  grid.cells.assign(cells, {0, 0});
}

}  // namespace

void lay_out(LightGrid& grid, double density, double error) {
  std::visit([&](const auto& view) { lay_out(grid, view, density, error); }, grid.view);
}

}  // namespace pah
