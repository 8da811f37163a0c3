// The kernel of tilted rays. Highway compiles this file once for each instruction set.
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

// Limits of one ray's walk: a ray that crosses more lines or cells traverses the BVH.
constexpr std::int32_t max_lines = 16;
constexpr std::size_t max_cells = std::size_t{3} * max_lines;
constexpr std::size_t typical_cells = 8;

constexpr auto places = static_cast<std::int32_t>(GridCell::places);

// One vector per ray of a batch, by component.
struct BatchVectors {
  float x[batch_size] = {}, y[batch_size] = {}, z[batch_size] = {};

  HWY_INLINE void set(std::size_t i, const Vec3& v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

// A batch of rays in the light's view: the origins (u and v in tiles) and the tiles crossed per
// unit of depth. Filled by loops that the compiler vectorizes.
struct ProjectedRays {
  alignas(64) float u[batch_size], v[batch_size], depth[batch_size];
  alignas(64) float slope_u[batch_size], slope_v[batch_size];
  alignas(64) std::int32_t within_cone[batch_size];  // 1: no more tilted than the bundle allows
};

HWY_INLINE void project(const LightGrid& grid, const ParallelView& view, const BatchVectors& origin,
                        const BatchVectors& direction, ProjectedRays& rays) {
  const Vec3 center = view.center();
  const glm::mat3 axes = view.axes();
  const GridFace& face = grid.faces[0];
  const float max_tangent = view.tangent() * tangent_allowance;
  for (std::size_t i = 0; i < batch_size; ++i) {
    const float x = origin.x[i] - center.x, y = origin.y[i] - center.y, z = origin.z[i] - center.z;
    const float u = axes[0].x * x + axes[0].y * y + axes[0].z * z;
    const float v = axes[1].x * x + axes[1].y * y + axes[1].z * z;
    const float dx = direction.x[i], dy = direction.y[i], dz = direction.z[i];
    const float du = axes[0].x * dx + axes[0].y * dy + axes[0].z * dz;
    const float dv = axes[1].x * dx + axes[1].y * dy + axes[1].z * dz;
    const float dw = axes[2].x * dx + axes[2].y * dy + axes[2].z * dz;
    rays.u[i] = (u - face.u) * face.per_length;
    rays.v[i] = (v - face.v) * face.per_length;
    rays.depth[i] = -(axes[2].x * x + axes[2].y * y + axes[2].z * z);
    rays.slope_u[i] = du / dw * face.per_length;
    rays.slope_v[i] = dv / dw * face.per_length;
    rays.within_cone[i] =
        dw > 0 && du * du + dv * dv <= max_tangent * max_tangent * dw * dw ? 1 : 0;
  }
}

// The tile in which ray i starts; the last tile stands for everything outside the face.
HWY_INLINE const GridTile& first_tile(const LightGrid& grid, const ProjectedRays& rays,
                                      std::size_t i) {
  const GridFace& face = grid.faces[0];
  const float u = rays.u[i], v = rays.v[i];
  const bool inside =
      u >= 0 && v >= 0 && u < static_cast<float>(face.columns) && v < static_cast<float>(face.rows);
  if (!inside) return grid.tiles.back();
  return grid.tiles[face.first_tile +
                    static_cast<std::uint32_t>(static_cast<std::int32_t>(v)) * face.columns +
                    static_cast<std::uint32_t>(static_cast<std::int32_t>(u))];
}

// A closed range of places along one axis, or of cells or tiles.
struct PlaceRange {
  std::int32_t low, high;

  [[nodiscard]] HWY_INLINE bool empty() const { return high < low; }
  // The cells (or tiles) that hold these places.
  [[nodiscard]] HWY_INLINE PlaceRange groups() const { return {low / places, high / places}; }
  [[nodiscard]] HWY_INLINE PlaceRange within(std::int32_t group) const {
    return {std::max(low - group * places, 0), std::min(high - group * places, places - 1)};
  }
};

HWY_INLINE PlaceRange places_between(float low, float high, std::int32_t count) {
  const auto end = static_cast<float>(count * places);
  if (!(high >= 0 && low < end)) return {0, -1};
  return {static_cast<std::int32_t>(std::max(low, 0.0F)),
          static_cast<std::int32_t>(std::min(high, end - 1))};
}

// A ray's projection between two points; `major` is the axis along which it is longer.
struct Segment {
  float first[2], last[2];
  int major;
};

// Columns and rows, of cells or of tiles.
struct GridSize {
  std::int32_t along[2];
};

// Calls `use(line, enters, m, n)` for every line (a column if the segment is longer along u, else a
// row) that the segment crosses. `enters` is the fraction of the segment before the line, `m` the
// places of the whole segment along its major axis, `n` its places across that axis within the
// line. Returns false if there are too many lines.
//
// The segment's ends are rounded already. Its crossings with a line add four roundings of at most
// 2^21 places: less than one place, by which `n` is widened.
template <typename Use>
HWY_INLINE bool for_each_line(const Segment& segment, const GridSize& size, const Use& use) {
  const int major = segment.major, minor = 1 - major;
  const float m0 = segment.first[major], m1 = segment.last[major];
  const float n0 = segment.first[minor], n1 = segment.last[minor];
  const float m_low = std::min(m0, m1), m_high = std::max(m0, m1);
  const PlaceRange m = places_between(m_low, m_high, size.along[major]);
  if (m.empty()) return true;
  const PlaceRange lines = m.groups();
  if (lines.high - lines.low >= max_lines) return false;
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
    const PlaceRange n = places_between(std::min(a, b) - 1, std::max(a, b) + 1, size.along[minor]);
    if (!n.empty()) use(line, enters, m, n);
  }
  return true;
}

// The bytes to compare with place_bytes() of a cell's entries for a ray that covers these places.
HWY_INLINE PlaceBytes overlapping(const PlaceRange& u, const PlaceRange& v) {
  constexpr std::int32_t last = places - 1;
  return (static_cast<std::uint32_t>(u.high) | static_cast<std::uint32_t>(last - u.low) << 8U |
          static_cast<std::uint32_t>(v.high) << 16U |
          static_cast<std::uint32_t>(last - v.low) << 24U) |
         eighth_bits;
}

// Writes the cells that one ray crosses to `found`.
class CellsCrossed {
 public:
  HWY_INLINE CellsCrossed(const LightGrid& grid, const ProjectedRays& rays, std::size_t i,
                          Place* found)
      : depth_(rays.depth[i]),
        rise_(std::max(depth_ - first_tile(grid, rays, i).nearest, 0.0F)),
        found_(found) {
    const GridFace& face = grid.faces[0];
    const Segment tiles{{rays.u[i], rays.v[i]},
                        {rays.u[i] + rays.slope_u[i] * rise_, rays.v[i] + rays.slope_v[i] * rise_},
                        0};
    if (stays_in_a_cell(tiles, first_tile(grid, rays, i))) return;
    const float width = std::abs(tiles.last[0] - tiles.first[0]);
    const float height = std::abs(tiles.last[1] - tiles.first[1]);
    major_ = width >= height ? 0 : 1;
    // Longer segments have rounding errors above one place.
    too_many_ = !(std::max(width, height) <= static_cast<float>(max_lines));
    if (too_many_) return;
    const GridSize size{
        {static_cast<std::int32_t>(face.columns), static_cast<std::int32_t>(face.rows)}};
    const bool few = for_each_line(
        scaled(tiles, 0, 0, places), size,
        [&](std::int32_t line, float, const PlaceRange&, const PlaceRange& across) HWY_ATTR {
          const PlaceRange crossed = across.groups();
          for (std::int32_t k = crossed.low; k <= crossed.high; ++k) {
            const std::int32_t column = major_ == 0 ? line : k, row = major_ == 0 ? k : line;
            add(tiles, column, row,
                grid.tiles[face.first_tile + static_cast<std::uint32_t>(row) * face.columns +
                           static_cast<std::uint32_t>(column)]);
          }
        });
    if (!few) too_many_ = true;
  }

  // The number of cells; nothing if there are too many.
  [[nodiscard]] HWY_INLINE std::optional<std::size_t> size() const {
    return too_many_ ? std::nullopt : std::optional(size_);
  }

 private:
  // The common case: adds the one cell that the ray crosses.
  HWY_INLINE bool stays_in_a_cell(const Segment& tiles, const GridTile& first) {
    const auto across = static_cast<std::int32_t>(first.across);
    const auto column = static_cast<std::int32_t>(tiles.first[0]);
    const auto row = static_cast<std::int32_t>(tiles.first[1]);
    const Segment segment = scaled(tiles, column, row, across * places);
    const float u_low = std::min(segment.first[0], segment.last[0]);
    const float v_low = std::min(segment.first[1], segment.last[1]);
    const auto end = static_cast<float>(across * places);
    const float u_high = std::max(segment.first[0], segment.last[0]);
    const float v_high = std::max(segment.first[1], segment.last[1]);
    if (!(u_low >= 0 && v_low >= 0 && u_high < end && v_high < end)) return false;
    const PlaceRange u{static_cast<std::int32_t>(u_low), static_cast<std::int32_t>(u_high)};
    const PlaceRange v{static_cast<std::int32_t>(v_low), static_cast<std::int32_t>(v_high)};
    const PlaceRange u_cells = u.groups(), v_cells = v.groups();
    if (u_cells.low != u_cells.high || v_cells.low != v_cells.high) return false;
    found_[size_++] = {
        first.first_cell + static_cast<std::uint32_t>(v_cells.low * across + u_cells.low), depth_,
        overlapping(u.within(u_cells.low), v.within(v_cells.low))};
    return true;
  }

  // The segment relative to a tile, `scale` units to a tile.
  [[nodiscard]] HWY_INLINE Segment scaled(const Segment& segment, std::int32_t column,
                                          std::int32_t row, std::int32_t scale) const {
    const float from[2] = {static_cast<float>(column), static_cast<float>(row)};
    const auto by = static_cast<float>(scale);
    return {{(segment.first[0] - from[0]) * by, (segment.first[1] - from[1]) * by},
            {(segment.last[0] - from[0]) * by, (segment.last[1] - from[1]) * by},
            major_};
  }

  // Adds the cells of one tile.
  HWY_INLINE void add(const Segment& tiles, std::int32_t column, std::int32_t row,
                      const GridTile& tile) {
    const auto across = static_cast<std::int32_t>(tile.across);
    const bool few = for_each_line(
        scaled(tiles, column, row, across * places), {{across, across}},
        [&](std::int32_t line, float enters, const PlaceRange& m, const PlaceRange& n) HWY_ATTR {
          const PlaceRange crossed = n.groups();
          for (std::int32_t k = crossed.low; k <= crossed.high; ++k) {
            if (size_ == max_cells) {
              too_many_ = true;
              return;
            }
            const PlaceRange in_line = m.within(line), in_cell = n.within(k);
            const std::int32_t u = major_ == 0 ? line : k, v = major_ == 0 ? k : line;
            found_[size_++] = {
                tile.first_cell + static_cast<std::uint32_t>(v * across + u),
                depth_ - enters * rise_,
                major_ == 0 ? overlapping(in_line, in_cell) : overlapping(in_cell, in_line)};
          }
        });
    if (!few) too_many_ = true;
  }

  float depth_, rise_;
  int major_ = 0;
  bool too_many_ = false;
  Place* found_;
  std::size_t size_ = 0;
};

// A ray and the cells that it crosses.
struct RayCells {
  std::uint32_t ray;
  std::span<const Place> cells;
};

template <bool counting>
HWY_INLINE void look_up(const LightGrid& grid, std::span<const RayCells> batch,
                        std::span<const Ray> rays, std::span<Answer> answers,
                        TraversalCounts& counts) {
  for (const RayCells& ray_cells : batch) {
    for (const Place& at : ray_cells.cells) __builtin_prefetch(list_of(grid, grid.cells[at.cell]));
  }
  Candidates<counting> candidates(grid, rays, answers, counts);
  for (const RayCells& ray_cells : batch) {
    std::size_t max_blocks = 0;
    for (const Place& at : ray_cells.cells) max_blocks += grid.cells[at.cell].count;
    if (!candidates.begin(ray_cells.ray, max_blocks)) {
      answers[ray_cells.ray] = Answer::unknown;
      continue;
    }
    for (const Place& at : ray_cells.cells) candidates.add(grid.cells[at.cell], at);
    candidates.end();
  }
  candidates.test_all();
}

template <bool counting>
HWY_INLINE void walk(const LightGrid& grid, const ParallelView& view, std::span<const Ray> rays,
                     std::span<Answer> answers, TraversalCounts& counts) {
  BatchVectors origins, directions;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    origins.set(i, rays[i].origin);
    directions.set(i, rays[i].direction);
  }
  ProjectedRays projected;
  project(grid, view, origins, directions, projected);
  for (std::size_t i = 0; i < rays.size(); ++i) __builtin_prefetch(&first_tile(grid, projected, i));
  Place cells[typical_cells * batch_size];
  std::size_t size = 0;
  RayCells batch[batch_size];
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    answers[i] = Answer::unknown;
    if (projected.within_cone[i] == 0 || !holds(grid.origins, rays[i].origin)) continue;
    if (size + max_cells > std::size(cells)) {
      look_up<counting>(grid, std::span(batch, count), rays, answers, counts);
      size = count = 0;
    }
    Place* const first = cells + size;
    const std::optional<std::size_t> crossed = CellsCrossed(grid, projected, i, first).size();
    if (!crossed) continue;
    answers[i] = Answer::free;
    for (std::size_t k = 0; k < *crossed; ++k) __builtin_prefetch(&grid.cells[first[k].cell]);
    batch[count++] = {i, std::span(first, *crossed)};
    size += *crossed;
  }
  look_up<counting>(grid, std::span(batch, count), rays, answers, counts);
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
