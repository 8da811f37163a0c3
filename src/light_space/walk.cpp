// Rays that lean against a sun's axis by little: their ways across the grid, cell by cell.
// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light_space/walk.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "light_space/cell_lists-inl.hpp"
#include "light_space/walk.hpp"

HWY_BEFORE_NAMESPACE();
namespace pah {
namespace HWY_NAMESPACE {
namespace {

// A ray that crosses more of them traverses.
constexpr std::int32_t most_lines = 16;
constexpr std::size_t most_cells = std::size_t{3} * most_lines;
constexpr std::size_t usual_cells = 8;

constexpr auto places = static_cast<std::int32_t>(GridCell::places);

struct Along {
  float x[batch_size] = {}, y[batch_size] = {}, z[batch_size] = {};

  HWY_INLINE void set(std::size_t i, const Vec3& v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

// Where the light sees a batch's rays begin, in tiles, and how they go on, in tiles by depth. Loops
// that are compiled to vectors.
struct Ways {
  alignas(64) float u[batch_size], v[batch_size], depth[batch_size];
  alignas(64) float slope_u[batch_size], slope_v[batch_size];
  alignas(64) std::int32_t leans_as_told[batch_size];
};

HWY_INLINE void find_ways(const LightGrid& grid, const ParallelView& view, const Along& origin,
                          const Along& direction, Ways& ways) {
  const Vec3 center = view.center();
  const glm::mat3 axes = view.axes();
  const GridFace& face = grid.faces[0];
  const float most = view.tangent() * leaning_allowance;
  for (std::size_t i = 0; i < batch_size; ++i) {
    const float x = origin.x[i] - center.x, y = origin.y[i] - center.y, z = origin.z[i] - center.z;
    const float u = axes[0].x * x + axes[0].y * y + axes[0].z * z;
    const float v = axes[1].x * x + axes[1].y * y + axes[1].z * z;
    const float dx = direction.x[i], dy = direction.y[i], dz = direction.z[i];
    const float du = axes[0].x * dx + axes[0].y * dy + axes[0].z * dz;
    const float dv = axes[1].x * dx + axes[1].y * dy + axes[1].z * dz;
    const float dw = axes[2].x * dx + axes[2].y * dy + axes[2].z * dz;
    ways.u[i] = (u - face.u) * face.per_length;
    ways.v[i] = (v - face.v) * face.per_length;
    ways.depth[i] = -(axes[2].x * x + axes[2].y * y + axes[2].z * z);
    ways.slope_u[i] = du / dw * face.per_length;
    ways.slope_v[i] = dv / dw * face.per_length;
    ways.leans_as_told[i] = dw > 0 && du * du + dv * dv <= most * most * dw * dw ? 1 : 0;
  }
}

// Where a ray starts; the last tile if that is outside of all.
HWY_INLINE const GridTile& first_tile(const LightGrid& grid, const Ways& ways, std::size_t i) {
  const GridFace& face = grid.faces[0];
  const float u = ways.u[i], v = ways.v[i];
  const bool inside =
      u >= 0 && v >= 0 && u < static_cast<float>(face.columns) && v < static_cast<float>(face.rows);
  if (!inside) return grid.tiles.back();
  return grid.tiles[face.first_tile +
                    static_cast<std::uint32_t>(static_cast<std::int32_t>(v)) * face.columns +
                    static_cast<std::uint32_t>(static_cast<std::int32_t>(u))];
}

// Places, or groups of them, from low to high.
struct Interval {
  std::int32_t low, high;

  [[nodiscard]] HWY_INLINE bool empty() const { return high < low; }
  // Whole cells, or tiles.
  [[nodiscard]] HWY_INLINE Interval groups() const { return {low / places, high / places}; }
  [[nodiscard]] HWY_INLINE Interval within(std::int32_t group) const {
    return {std::max(low - group * places, 0), std::min(high - group * places, places - 1)};
  }
};

HWY_INLINE Interval places_between(float low, float high, std::int32_t count) {
  const auto end = static_cast<float>(count * places);
  if (!(high >= 0 && low < end)) return {0, -1};
  return {static_cast<std::int32_t>(std::max(low, 0.0F)),
          static_cast<std::int32_t>(std::min(high, end - 1))};
}

// From one end to the other, in places; `along` is the axis that it is longer along.
struct Way {
  float first[2], last[2];
  int along;
};

// A rectangle of cells, or of tiles.
struct Extent {
  std::int32_t size[2];
};

// Calls `use(line, enters, m, n)` for every column that the way crosses, or every row if it is
// longer along those: with the share of the way before it, the places that all of the way has along
// its longer axis, and those that it has across it in this line. False if there are too many lines.
//
// The way is that of rounded ends. Where it enters and leaves a line has four more roundings, of at
// most 2^21 places: less than one place, which is allowed for.
template <typename Use>
HWY_INLINE bool for_each_line(const Way& way, const Extent& extent, const Use& use) {
  const int along = way.along, across = 1 - along;
  const float m0 = way.first[along], m1 = way.last[along];
  const float n0 = way.first[across], n1 = way.last[across];
  const float m_low = std::min(m0, m1), m_high = std::max(m0, m1);
  const Interval m = places_between(m_low, m_high, extent.size[along]);
  if (m.empty()) return true;
  const Interval lines = m.groups();
  if (lines.high - lines.low >= most_lines) return false;
  for (std::int32_t line = lines.low; line <= lines.high; ++line) {
    const auto low = static_cast<float>(line * places);
    const float high = low + static_cast<float>(places);
    float enters = 0, leaves = 1;
    if (m_low < low || m_high >= high) {
      const float a = (low - m0) / (m1 - m0), b = (high - m0) / (m1 - m0);
      enters = std::max(std::min(a, b), 0.0F);
      leaves = std::min(std::max(a, b), 1.0F);
    }
    const float a = n0 + (n1 - n0) * enters, b = n0 + (n1 - n0) * leaves;
    const Interval n = places_between(std::min(a, b) - 1, std::max(a, b) + 1, extent.size[across]);
    if (!n.empty()) use(line, enters, m, n);
  }
  return true;
}

// Which places of other cells a ray that lies over these overlaps: see place_bytes.
HWY_INLINE PlaceBytes overlapping(const Interval& u, const Interval& v) {
  constexpr std::int32_t last = places - 1;
  return (static_cast<std::uint32_t>(u.high) | static_cast<std::uint32_t>(last - u.low) << 8U |
          static_cast<std::uint32_t>(v.high) << 16U |
          static_cast<std::uint32_t>(last - v.low) << 24U) |
         eighth_bits;
}

// The cells that a ray crosses, and how many; nothing if there are too many.
class CellsCrossed {
 public:
  HWY_INLINE CellsCrossed(const LightGrid& grid, const Ways& ways, std::size_t i, Place* found)
      : depth_(ways.depth[i]),
        rise_(std::max(depth_ - first_tile(grid, ways, i).nearest, 0.0F)),
        found_(found) {
    const GridFace& face = grid.faces[0];
    const Way tiles{{ways.u[i], ways.v[i]},
                    {ways.u[i] + ways.slope_u[i] * rise_, ways.v[i] + ways.slope_v[i] * rise_},
                    0};
    if (stays_in_a_cell(tiles, first_tile(grid, ways, i))) return;
    const float width = std::abs(tiles.last[0] - tiles.first[0]);
    const float height = std::abs(tiles.last[1] - tiles.first[1]);
    along_ = width >= height ? 0 : 1;
    // Longer ones would round to more than a place.
    too_many_ = !(std::max(width, height) <= static_cast<float>(most_lines));
    if (too_many_) return;
    const Extent extent{
        {static_cast<std::int32_t>(face.columns), static_cast<std::int32_t>(face.rows)}};
    const bool few = for_each_line(
        scaled(tiles, 0, 0, places), extent,
        [&](std::int32_t line, float, const Interval&, const Interval& across) HWY_ATTR {
          const Interval crossed = across.groups();
          for (std::int32_t k = crossed.low; k <= crossed.high; ++k) {
            const std::int32_t column = along_ == 0 ? line : k, row = along_ == 0 ? k : line;
            add(tiles, column, row,
                grid.tiles[face.first_tile + static_cast<std::uint32_t>(row) * face.columns +
                           static_cast<std::uint32_t>(column)]);
          }
        });
    if (!few) too_many_ = true;
  }

  [[nodiscard]] HWY_INLINE std::optional<std::size_t> size() const {
    return too_many_ ? std::nullopt : std::optional(size_);
  }

 private:
  // Most ways do.
  HWY_INLINE bool stays_in_a_cell(const Way& tiles, const GridTile& first) {
    const auto across = static_cast<std::int32_t>(first.across);
    const auto column = static_cast<std::int32_t>(tiles.first[0]);
    const auto row = static_cast<std::int32_t>(tiles.first[1]);
    const Way way = scaled(tiles, column, row, across * places);
    const float u_low = std::min(way.first[0], way.last[0]);
    const float v_low = std::min(way.first[1], way.last[1]);
    const auto end = static_cast<float>(across * places);
    const float u_high = std::max(way.first[0], way.last[0]);
    const float v_high = std::max(way.first[1], way.last[1]);
    if (!(u_low >= 0 && v_low >= 0 && u_high < end && v_high < end)) return false;
    const Interval u{static_cast<std::int32_t>(u_low), static_cast<std::int32_t>(u_high)};
    const Interval v{static_cast<std::int32_t>(v_low), static_cast<std::int32_t>(v_high)};
    const Interval u_cells = u.groups(), v_cells = v.groups();
    if (u_cells.low != u_cells.high || v_cells.low != v_cells.high) return false;
    found_[size_++] = {
        first.first_cell + static_cast<std::uint32_t>(v_cells.low * across + u_cells.low), depth_,
        overlapping(u.within(u_cells.low), v.within(v_cells.low))};
    return true;
  }

  // In places of a tile, or of all tiles.
  [[nodiscard]] HWY_INLINE Way scaled(const Way& way, std::int32_t column, std::int32_t row,
                                      std::int32_t scale) const {
    const float from[2] = {static_cast<float>(column), static_cast<float>(row)};
    const auto by = static_cast<float>(scale);
    return {{(way.first[0] - from[0]) * by, (way.first[1] - from[1]) * by},
            {(way.last[0] - from[0]) * by, (way.last[1] - from[1]) * by},
            along_};
  }

  HWY_INLINE void add(const Way& tiles, std::int32_t column, std::int32_t row,
                      const GridTile& tile) {
    const auto across = static_cast<std::int32_t>(tile.across);
    const bool few = for_each_line(
        scaled(tiles, column, row, across * places), {{across, across}},
        [&](std::int32_t line, float enters, const Interval& m, const Interval& n) HWY_ATTR {
          const Interval crossed = n.groups();
          for (std::int32_t k = crossed.low; k <= crossed.high; ++k) {
            if (size_ == most_cells) {
              too_many_ = true;
              return;
            }
            const Interval in_line = m.within(line), in_cell = n.within(k);
            const std::int32_t u = along_ == 0 ? line : k, v = along_ == 0 ? k : line;
            found_[size_++] = {
                tile.first_cell + static_cast<std::uint32_t>(v * across + u),
                depth_ - enters * rise_,
                along_ == 0 ? overlapping(in_line, in_cell) : overlapping(in_cell, in_line)};
          }
        });
    if (!few) too_many_ = true;
  }

  float depth_, rise_;
  int along_ = 0;
  bool too_many_ = false;
  Place* found_;
  std::size_t size_ = 0;
};

// A ray and the cells that it crosses.
struct Crossing {
  std::uint32_t ray;
  std::span<const Place> cells;
};

template <bool counting>
HWY_INLINE void look_up(const LightGrid& grid, std::span<const Crossing> crossings,
                        std::span<const Ray> rays, std::span<Answer> answers,
                        TraversalCounts& counts) {
  for (const Crossing& crossing : crossings) {
    for (const Place& at : crossing.cells) __builtin_prefetch(list_of(grid, grid.cells[at.cell]));
  }
  Candidates<counting> candidates(grid, rays, answers, counts);
  for (const Crossing& crossing : crossings) {
    std::size_t most = 0;
    for (const Place& at : crossing.cells) most += grid.cells[at.cell].count;
    if (!candidates.begin(crossing.ray, most)) {
      answers[crossing.ray] = Answer::unknown;
      continue;
    }
    for (const Place& at : crossing.cells) candidates.add(grid.cells[at.cell], at);
    candidates.end();
  }
  candidates.test_all();
}

template <bool counting>
HWY_INLINE void walk(const LightGrid& grid, const ParallelView& view, std::span<const Ray> rays,
                     std::span<Answer> answers, TraversalCounts& counts) {
  Along origins, directions;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    origins.set(i, rays[i].origin);
    directions.set(i, rays[i].direction);
  }
  Ways ways;
  find_ways(grid, view, origins, directions, ways);
  for (std::size_t i = 0; i < rays.size(); ++i) __builtin_prefetch(&first_tile(grid, ways, i));
  Place cells[usual_cells * batch_size];
  std::size_t size = 0;
  Crossing crossings[batch_size];
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    answers[i] = Answer::unknown;
    if (ways.leans_as_told[i] == 0 || !holds(grid.origins, rays[i].origin)) continue;
    if (size + most_cells > std::size(cells)) {
      look_up<counting>(grid, std::span(crossings, count), rays, answers, counts);
      size = count = 0;
    }
    Place* const first = cells + size;
    const std::optional<std::size_t> crossed = CellsCrossed(grid, ways, i, first).size();
    if (!crossed) continue;
    answers[i] = Answer::free;
    for (std::size_t k = 0; k < *crossed; ++k) __builtin_prefetch(&grid.cells[first[k].cell]);
    crossings[count++] = {i, std::span(first, *crossed)};
    size += *crossed;
  }
  look_up<counting>(grid, std::span(crossings, count), rays, answers, counts);
}

void walk_kernel(const LightGrid& grid, const ParallelView& view, std::span<const Ray> rays,
                 std::span<Answer> answers, TraversalCounts* counts) {
  TraversalCounts none;
  for (std::size_t first = 0; first < rays.size(); first += batch_size) {
    const std::size_t size = std::min(batch_size, rays.size() - first);
    if (counts != nullptr) {
      walk<true>(grid, view, rays.subspan(first, size), answers.subspan(first, size), *counts);
    } else {
      walk<false>(grid, view, rays.subspan(first, size), answers.subspan(first, size), none);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace pah
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pah {

namespace {
HWY_EXPORT(walk_kernel);
}  // namespace

void walk(const LightGrid& grid, const ParallelView& view, std::span<const Ray> rays,
          std::span<LightGrid::Answer> answers, TraversalCounts* counts) {
  HWY_DYNAMIC_DISPATCH(walk_kernel)(grid, view, rays, answers, counts);
}

}  // namespace pah
#endif
