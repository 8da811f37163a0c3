#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel_for.hpp"
#include "geometry/ray_box.hpp"
#include "geometry/rounding.hpp"
#include "light_space/cell_entries.hpp"
#include "light_space/grid_layout.hpp"
#include "light_space/light_grid.hpp"
#include "light_space/outline.hpp"
#include "light_space/reach.hpp"

namespace pah {

namespace {

constexpr std::size_t blocks_per_task = 1024;

// Keeps both the lists short and empty cells rare.
constexpr double cells_per_triangle = 0.25;

constexpr std::size_t typical_entries_per_block = 12;

// Where large triangles overlap, most cells would list most of them. If the lists exceed this
// limit, the grid is laid out again with fewer cells, down to about one cell per face.
constexpr std::uint64_t max_entries_per_block = 32;
static_assert(max_entries_per_block > CubeView::faces);
static_assert(max_entries_per_block * ChildRef::max_blocks < 1ULL << 32U);

std::variant<CubeView, ParallelView> view_of(const ExactBundle& bundle, const Aabb& box) {
  if (const auto* point = std::get_if<PointBundle>(&bundle)) return CubeView(*point);
  return ParallelView(std::get<ParallelBundle>(bundle), box.center());
}

Aabb bounds_of(const Bvh& bvh) {
  return parallel_fold(
      bvh.blocks.size(), blocks_per_task, Aabb{},
      [&](std::size_t first, std::size_t last) {
        Aabb box;
        for (std::size_t i = first; i < last; ++i) box.extend(bounds_of(bvh.blocks[i]));
        return box;
      },
      [](Aabb& total, const Aabb& box) { total.extend(box); });
}

// A bound, along every axis of a face, on the distance from a triangle of a ray that hits it:
// light_grid.hpp derives it. The axes of a cube's faces are those of the world.
double error_of(const PointBundle& bundle, const Aabb& origins) {
  const DVec3 eye(bundle.eye);
  const DVec3 away =
      glm::max(glm::abs(DVec3(origins.min) - eye), glm::abs(DVec3(origins.max) - eye));
  const DVec3 size = DVec3(origins.max) - DVec3(origins.min);
  return double{rounding_bound(40)} * std::max({away.x, away.y, away.z, size.x, size.y, size.z});
}
double error_of(const ParallelBundle& bundle, const Aabb& origins) {
  const DVec3 size = DVec3(origins.max) - DVec3(origins.min);
  const float rounding = bundle.tangent > 0 ? rounding_bound(52) : rounding_bound(36);
  return std::sqrt(3.0) * double{rounding} * std::max({size.x, size.y, size.z});
}

// The outlines of a block's triangles on one face.
struct Outlines {
  std::array<Outline, TriangleBlock::width> outlines;
  std::size_t size = 0;

  [[nodiscard]] std::span<const Outline> all() const { return std::span(outlines).first(size); }
};

// The interval of u that they cover for v in `v`.
Interval across(const Outlines& outlines, const Interval& v) {
  Interval u;
  for (const Outline& outline : outlines.all()) u.extend(across(outline, v));
  return u;
}

// `count` equal parts of an axis.
struct EqualParts {
  double first, per_length;
  std::uint32_t count;

  [[nodiscard]] Interval at(std::uint32_t i) const {
    return {first + i / per_length, first + (i + 1) / per_length};
  }
};

// A closed range of places, cells or tiles along one axis.
struct Indices {
  std::uint32_t first, last;
};
// The parts that the interval touches, if any.
std::optional<Indices> indices_of(const Interval& range, const EqualParts& parts) {
  const double low = std::floor((range.min - parts.first) * parts.per_length);
  const double high = std::floor((range.max - parts.first) * parts.per_length);
  if (!(low < parts.count && high >= 0)) return {};
  return Indices{static_cast<std::uint32_t>(std::max(low, 0.0)),
                 static_cast<std::uint32_t>(std::min(high, parts.count - 1.0))};
}

// The cells that hold the places, and the places relative to one of these cells.
Indices in_cells(const Indices& places) {
  return {places.first / GridCell::places, places.last / GridCell::places};
}
Indices within(std::uint32_t cell, const Indices& places) {
  const std::uint32_t first = cell * GridCell::places;
  return {std::max(places.first, first) - first,
          std::min(places.last, first + GridCell::places - 1) - first};
}

template <typename View>
class GridBuilder {
 public:
  GridBuilder(LightGrid& grid, const View& view, double error)
      : grid_(grid), view_(view), error_(error) {}

  void build() {
    for (double density = cells_per_triangle;; density /= 4) {
      lay_out(grid_, density, error_);
      const std::size_t tasks = (grid_.bvh->blocks.size() + blocks_per_task - 1) / blocks_per_task;
      CellEntries entries(tasks, grid_.cells.size());
      if (!place(entries, tasks)) continue;
      entries.sort_into(grid_);
      return;
    }
  }

 private:
  [[nodiscard]] static std::size_t triangles_in(const TriangleBlock& block) {
    std::size_t count = 1;
    while (count < TriangleBlock::width && block.indices[count] != block.indices[count - 1])
      ++count;
    return count;
  }

  // False if the face certainly sees nothing of the box: then it need not be projected.
  [[nodiscard]] bool may_see(int face, const Aabb& box) const {
    if constexpr (std::is_same_v<View, CubeView>) {
      if (grid_.faces[static_cast<std::size_t>(face)].columns == 0) return false;
      const DVec3 p = view_.local(face, DVec3(box.min)), q = view_.local(face, DVec3(box.max));
      const DVec3 low = glm::min(p, q), high = glm::max(p, q);
      // Twice the tangent of the face's border leaves room for all errors.
      return high.z > 0 && low.x <= 2 * high.z && high.x >= -2 * high.z && low.y <= 2 * high.z &&
             high.y >= -2 * high.z;
    }
    return true;
  }

  // Calls `use(face, outlines)` for every face that sees something of the block.
  template <typename Use>
  void for_each_face(const TriangleBlock& block, const Use& use) const {
    const std::size_t count = triangles_in(block);
    const Aabb box = bounds_of(block);
    for (int face = 0; face < View::faces; ++face) {
      if (!may_see(face, box)) continue;
      Outlines outlines;
      for (std::size_t i = 0; i < count; ++i) {
        if (const auto outline = outline_on(view_, face, block.triangle(i), error_))
          outlines.outlines[outlines.size++] = *outline;
      }
      if (outlines.size > 0) use(face, outlines);
    }
  }

  // Calls `use(cell, entry)` for every cell that sees something of the block.
  template <typename Use>
  void for_each_cell(const GridFace& face, std::uint32_t block, const Outlines& outlines,
                     const Use& use) const {
    Interval u, v;
    for (const Outline& outline : outlines.all()) {
      u.extend(outline.range(0));
      v.extend(outline.range(1));
    }
    const EqualParts columns{face.u, face.per_length, face.columns};
    const EqualParts rows{face.v, face.per_length, face.rows};
    const auto crossed = indices_of(v, rows);
    if (!crossed) return;
    for (std::uint32_t row = crossed->first; row <= crossed->last; ++row) {
      const Interval strip = rows.at(row);
      const Interval u_in = crossed->first < crossed->last ? across(outlines, strip) : u;
      const auto tiles = indices_of(u_in, columns);
      if (!tiles) continue;
      for (std::uint32_t column = tiles->first; column <= tiles->last; ++column) {
        const GridTile& tile = grid_.tiles[face.first_tile + row * face.columns + column];
        const double per_length = double{face.per_length} * tile.across * GridCell::places;
        const std::uint32_t places = tile.across * GridCell::places;
        for_each_cell_of(tile, {columns.at(column).min, per_length, places},
                         {strip.min, per_length, places}, u_in, v, block, outlines, use);
      }
    }
  }

  // The same for one tile, given its places and the intervals that the block covers.
  template <typename Use>
  void for_each_cell_of(const GridTile& tile, const EqualParts& u_places,
                        const EqualParts& v_places, const Interval& u, const Interval& v,
                        std::uint32_t block, const Outlines& outlines, const Use& use) const {
    const auto v_seen = indices_of(v, v_places);
    if (!v_seen) return;
    const double half = 0.5 * GridCell::places / u_places.per_length;
    const Indices rows = in_cells(*v_seen);
    for (std::uint32_t row = rows.first; row <= rows.last; ++row) {
      const double low = v_places.first + 2 * half * row;
      const Interval u_in = rows.first < rows.last ? across(outlines, {low, low + 2 * half}) : u;
      const auto u_seen = indices_of(u_in, u_places);
      if (!u_seen) continue;
      const Indices columns = in_cells(*u_seen), in_row = within(row, *v_seen);
      for (std::uint32_t column = columns.first; column <= columns.last; ++column) {
        const DVec2 center(u_places.first + half * (2 * column + 1), low + half);
        const Indices in_column = within(column, *u_seen);
        use(tile.first_cell + row * tile.across + column,
            CellEntry{stored(nearest_in(center, half, outlines)),
                      place_bytes(in_column.first, in_column.last, in_row.first, in_row.last),
                      block});
      }
    }
  }

  // A lower bound of the block's depths in a cell, given the cell's center and half its side.
  [[nodiscard]] double nearest_in(const DVec2& center, double half,
                                  const Outlines& outlines) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Outline& outline : outlines.all()) {
      const double middle = outline.offset + glm::dot(outline.slope, center);
      const double change =
          (std::abs(outline.slope.x) + std::abs(outline.slope.y)) * (half + outline.margin);
      double bound = outline.nearest;
      if (std::is_same_v<View, CubeView>) {
        if (middle + change > 0) bound = 1 / (middle + change);
      } else {
        bound = middle - change;
      }
      nearest = std::min(nearest, std::max(bound, outline.nearest));
    }
    return nearest;
  }

  // A ray's origin is compared with this depth, and a hit's depth may exceed the origin's by one
  // error. The second error covers the rounding of the triangle's plane.
  [[nodiscard]] float stored(double nearest) const { return rounded_down(nearest - 2 * error_); }

  // Adds the entries of all blocks. Returns false if they are too many.
  [[nodiscard]] bool place(CellEntries& entries, std::size_t tasks) const {
    const std::size_t blocks = grid_.bvh->blocks.size();
    const std::uint64_t limit = max_entries_per_block * blocks;
    std::atomic<std::uint64_t> total = 0;
    parallel_for(tasks, 1, [&](std::size_t task) {
      auto& placed = entries.of_task(task);
      placed.reserve(typical_entries_per_block * blocks_per_task);
      const std::size_t last = std::min((task + 1) * blocks_per_task, blocks);
      std::size_t counted = 0;
      for (std::size_t i = task * blocks_per_task; i < last; ++i) {
        if (total.fetch_add(placed.size() - counted, std::memory_order_relaxed) > limit) return;
        counted = placed.size();
        for_each_face(grid_.bvh->blocks[i], [&](int face, const Outlines& outlines) {
          for_each_cell(grid_.faces[static_cast<std::size_t>(face)], static_cast<std::uint32_t>(i),
                        outlines, [&](std::uint32_t cell, const CellEntry& entry) {
                          placed.push_back({cell, entry});
                          entries.count(cell);
                        });
        });
      }
      total.fetch_add(placed.size() - counted, std::memory_order_relaxed);
    });
    return total <= limit;
  }

  LightGrid& grid_;
  const View& view_;
  double error_;
};

// The blocks whose boxes come nearer to the eye than `distance` along every axis.
std::vector<std::uint32_t> blocks_near(const Bvh& bvh, const Vec3& eye, double distance) {
  std::vector<std::uint32_t> near;
  for (std::size_t i = 0; i < bvh.blocks.size(); ++i) {
    const Aabb box = bounds_of(bvh.blocks[i]);
    const DVec3 gap = glm::max(DVec3(box.min) - DVec3(eye), DVec3(eye) - DVec3(box.max));
    if (std::max({gap.x, gap.y, gap.z}) < distance) near.push_back(static_cast<std::uint32_t>(i));
  }
  return near;
}

}  // namespace

LightGrid::LightGrid(const Bvh& over, const ExactBundle& bundle)
    : bvh(&over), view(view_of(bundle, bounds_of(over))) {
  const Aabb box = bounds_of(over);
  // Rays start on triangles or slightly off them.
  const float around = 0x1p-10F * (box.empty() ? 0 : largest_of(box.extent()));
  origins = {box.min - around, box.max + around};
  const double error = std::visit([&](const auto& b) { return error_of(b, origins); }, bundle);
  if (!(around > 0) || !std::isfinite(error)) {
    origins = {};
    tiles.assign(1, {0, 1});
    cells.assign(1, {0, 0});
    return;
  }
  std::visit([&](const auto& any) { GridBuilder(*this, any, error).build(); }, view);
  const auto* parallel = std::get_if<ParallelView>(&view);
  if (parallel != nullptr && parallel->tangent() > 0) find_reach(*this, parallel->tangent());
  // The faces of a cone end at the cone: rays outside of them are unknown.
  const auto* cube = std::get_if<CubeView>(&view);
  if (cube != nullptr && cube->is_cone()) cells.back().count = GridCell::unknown;
  if (const auto* point = std::get_if<PointBundle>(&bundle))
    near_blocks = blocks_near(over, point->eye, (nearest_on_faces + 4) * error);
}

}  // namespace pah
