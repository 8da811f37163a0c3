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

// A ray that crosses more traverses.
constexpr int most_cells_along = 16;
constexpr std::size_t most_cells = std::size_t{3} * most_cells_along;
constexpr std::size_t usual_cells = 8;

// What a batch's rays cross: in places of the grid from the origin to where all triangles are
// behind, and depths. Loops that are compiled to vectors.
struct Ways {
  alignas(64) float first_u[batch_size], first_v[batch_size];
  alignas(64) float last_u[batch_size], last_v[batch_size];
  alignas(64) float depth[batch_size], rise[batch_size];
  alignas(64) std::int32_t leans_little[batch_size];
};

struct Along {
  float x[batch_size] = {}, y[batch_size] = {}, z[batch_size] = {};

  HWY_INLINE void set(std::size_t i, const Vec3& v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

HWY_INLINE void find_ways(const LightGrid& grid, const ParallelView& view, const Along& origin,
                          const Along& direction, Ways& ways) {
  const Vec3 center = view.center();
  const glm::mat3 axes = view.axes();
  const GridFace& face = grid.faces[0];
  for (std::size_t i = 0; i < batch_size; ++i) {
    const float x = origin.x[i] - center.x, y = origin.y[i] - center.y, z = origin.z[i] - center.z;
    const float u = axes[0].x * x + axes[0].y * y + axes[0].z * z;
    const float v = axes[1].x * x + axes[1].y * y + axes[1].z * z;
    const float depth = -(axes[2].x * x + axes[2].y * y + axes[2].z * z);
    const float dx = direction.x[i], dy = direction.y[i], dz = direction.z[i];
    const float du = axes[0].x * dx + axes[0].y * dy + axes[0].z * dz;
    const float dv = axes[1].x * dx + axes[1].y * dy + axes[1].z * dz;
    const float dw = axes[2].x * dx + axes[2].y * dy + axes[2].z * dz;
    const float rise = std::max(depth - grid.nearest, 0.0F);
    const float share = rise / dw;
    ways.first_u[i] = (u - face.u) * face.per_length;
    ways.first_v[i] = (v - face.v) * face.per_length;
    ways.last_u[i] = (u + du * share - face.u) * face.per_length;
    ways.last_v[i] = (v + dv * share - face.v) * face.per_length;
    ways.depth[i] = depth;
    ways.rise[i] = rise;
    ways.leans_little[i] = dw > 0 && std::abs(du) <= dw && std::abs(dv) <= dw ? 1 : 0;
  }
}

// A row or column of the cells of a face.
struct Line {
  std::uint32_t cells, stride;
};

// The places from low to high, in whole cells and within one of them.
struct Interval {
  std::int32_t low, high;

  [[nodiscard]] HWY_INLINE Interval cells() const {
    constexpr auto places = static_cast<std::int32_t>(GridFace::places);
    return {low / places, high / places};
  }
  [[nodiscard]] HWY_INLINE Interval within(std::int32_t cell) const {
    constexpr auto places = static_cast<std::int32_t>(GridFace::places);
    return {std::max(low - cell * places, 0), std::min(high - cell * places, places - 1)};
  }
};

// Of the places of a line of cells; empty (high < low) if all are outside.
HWY_INLINE Interval on_line(float low, float high, const Line& line) {
  const auto end = static_cast<float>(line.cells * GridFace::places);
  if (!(high >= 0 && low < end)) return {0, -1};
  return {static_cast<std::int32_t>(std::max(low, 0.0F)),
          static_cast<std::int32_t>(std::min(high, end - 1))};
}

// Which places of other cells a ray that lies over these overlaps: see place_bytes.
HWY_INLINE PlaceBytes overlapping(const Interval& u, const Interval& v) {
  constexpr std::int32_t last = GridFace::places - 1;
  return (static_cast<std::uint32_t>(u.high) | static_cast<std::uint32_t>(last - u.low) << 8U |
          static_cast<std::uint32_t>(v.high) << 16U |
          static_cast<std::uint32_t>(last - v.low) << 24U) |
         eighth_bits;
}

// The cells that a way crosses, by lines of cells across the axis along which it is longer; how
// many, or no answer if there are too many. The way is that of rounded ends. Where it enters and
// leaves a line of cells has four more roundings, of at most 2^21 places: less than one place,
// which is allowed for.
HWY_INLINE std::optional<std::size_t> cells_crossed(const LightGrid& grid, const Ways& ways,
                                                    std::size_t i, Place* cells_of_way) {
  constexpr auto places = static_cast<float>(GridFace::places);
  const GridFace& face = grid.faces[0];
  const float first[2] = {ways.first_u[i], ways.first_v[i]};
  const float last[2] = {ways.last_u[i], ways.last_v[i]};
  const Line lines[2] = {{face.columns, 1}, {face.rows, face.columns}};
  const int longer = std::abs(last[0] - first[0]) >= std::abs(last[1] - first[1]) ? 0 : 1;
  const int other = 1 - longer;
  const float m0 = first[longer], m1 = last[longer], n0 = first[other], n1 = last[other];
  const Interval all = on_line(std::min(m0, m1), std::max(m0, m1), lines[longer]);
  if (all.high < all.low) return 0;
  const Interval cells = all.cells();
  if (cells.high - cells.low >= most_cells_along) return std::nullopt;
  std::size_t size = 0;
  for (std::int32_t cell = cells.low; cell <= cells.high; ++cell) {
    float enters = 0, leaves = 1;
    if (cells.high > cells.low) {
      const float low = (static_cast<float>(cell) * places - m0) / (m1 - m0);
      const float high = (static_cast<float>(cell + 1) * places - m0) / (m1 - m0);
      enters = std::max(std::min(low, high), 0.0F);
      leaves = std::min(std::max(low, high), 1.0F);
    }
    const float a = n0 + (n1 - n0) * enters, b = n0 + (n1 - n0) * leaves;
    const Interval across = on_line(std::min(a, b) - 1, std::max(a, b) + 1, lines[other]);
    if (across.high < across.low) continue;
    const Interval crossed = across.cells();
    for (std::int32_t k = crossed.low; k <= crossed.high; ++k) {
      if (size == most_cells) return std::nullopt;
      const Interval m = all.within(cell), n = across.within(k);
      cells_of_way[size++] = {face.first_cell +
                                  static_cast<std::uint32_t>(cell) * lines[longer].stride +
                                  static_cast<std::uint32_t>(k) * lines[other].stride,
                              ways.depth[i] - enters * ways.rise[i],
                              longer == 0 ? overlapping(m, n) : overlapping(n, m)};
    }
  }
  return size;
}

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
  Place cells[usual_cells * batch_size];
  std::size_t size = 0;
  Crossing crossings[batch_size];
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    answers[i] = Answer::unknown;
    if (ways.leans_little[i] == 0 || !holds(grid.origins, rays[i].origin)) continue;
    if (size + most_cells > std::size(cells)) {
      look_up<counting>(grid, std::span(crossings, count), rays, answers, counts);
      size = count = 0;
    }
    Place* const first = cells + size;
    const std::optional<std::size_t> crossed = cells_crossed(grid, ways, i, first);
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
