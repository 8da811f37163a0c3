// The look-up kernels. Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light_space/look_up.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>
#include <algorithm>
#include <cmath>

#include "light_space/cell_lists-inl.hpp"
#include "light_space/walk.hpp"

HWY_BEFORE_NAMESPACE();
namespace pah {
namespace HWY_NAMESPACE {
namespace {

// The places of a batch's origins in the light's view. The loops that fill it are vectorized.
struct BatchPlaces {
  alignas(64) float u[batch_size], v[batch_size], depth[batch_size];
  alignas(64) std::int32_t face[batch_size];
};

HWY_INLINE void see(const CubeView& view, const float (&x)[batch_size],
                    const float (&y)[batch_size], const float (&z)[batch_size], BatchPlaces& seen) {
  const Vec3 eye = view.eye();
  for (std::size_t i = 0; i < batch_size; ++i) {
    const float wx = x[i] - eye.x, wy = y[i] - eye.y, wz = z[i] - eye.z;
    const float ax = std::abs(wx), ay = std::abs(wy), az = std::abs(wz);
    const bool along_x = ax >= ay && ax >= az;
    const bool along_y = ay >= az;
    const float w = along_x ? wx : along_y ? wy : wz;
    const float a = along_x ? wy : along_y ? wz : wx;
    const float b = along_x ? wz : along_y ? wx : wy;
    const float inverse = 1 / std::abs(w);
    seen.u[i] = a * inverse;
    seen.v[i] = b * inverse;
    seen.depth[i] = std::abs(w);
    seen.face[i] = (along_x ? 0 : along_y ? 1 : 2) + (w < 0 ? 3 : 0);
  }
}

HWY_INLINE void see(const ParallelView& view, const float (&x)[batch_size],
                    const float (&y)[batch_size], const float (&z)[batch_size], BatchPlaces& seen) {
  const Vec3 center = view.center();
  const glm::mat3 axes = view.axes();
  for (std::size_t i = 0; i < batch_size; ++i) {
    const float wx = x[i] - center.x, wy = y[i] - center.y, wz = z[i] - center.z;
    seen.u[i] = axes[0].x * wx + axes[0].y * wy + axes[0].z * wz;
    seen.v[i] = axes[1].x * wx + axes[1].y * wy + axes[1].z * wz;
    seen.depth[i] = -(axes[2].x * wx + axes[2].y * wy + axes[2].z * wz);
    seen.face[i] = 0;
  }
}

// Whether the ray belongs to the light's bundle.
HWY_INLINE bool is_of(const CubeView& view, const Ray& ray) {
  return ray.t_max <= 1 && view.eye() - ray.origin == ray.direction;
}
HWY_INLINE bool is_of(const ParallelView& view, const Ray& ray) {
  return ray.direction == view.toward();
}

// The tile in which a ray starts, and its place there as fractions of the tile's side.
struct InTile {
  std::uint32_t tile;
  float u, v;
};
HWY_INLINE InTile in_tile(const LightGrid& grid, const BatchPlaces& seen, std::size_t i) {
  const GridFace& face = grid.faces[static_cast<std::size_t>(seen.face[i])];
  const float u = (seen.u[i] - face.u) * face.per_length;
  const float v = (seen.v[i] - face.v) * face.per_length;
  const bool inside =
      u >= 0 && v >= 0 && u < static_cast<float>(face.columns) && v < static_cast<float>(face.rows);
  if (!inside) return {static_cast<std::uint32_t>(grid.tiles.size() - 1), 0, 0};
  const auto column = static_cast<std::int32_t>(u), row = static_cast<std::int32_t>(v);
  return {face.first_tile + static_cast<std::uint32_t>(row) * face.columns +
              static_cast<std::uint32_t>(column),
          u - static_cast<float>(column), v - static_cast<float>(row)};
}

HWY_INLINE Place place_of(const LightGrid& grid, const InTile& at, float depth) {
  constexpr std::uint32_t places = GridCell::places;
  const GridTile tile = grid.tiles[at.tile];
  const auto across = static_cast<float>(tile.across * places);
  const auto place_u = static_cast<std::uint32_t>(static_cast<std::int32_t>(at.u * across));
  const auto place_v = static_cast<std::uint32_t>(static_cast<std::int32_t>(at.v * across));
  const std::uint32_t u_in = place_u % places, v_in = place_v % places;
  return {tile.first_cell + place_v / places * tile.across + place_u / places, depth,
          place_bytes(u_in, u_in, v_in, v_in) | eighth_bits};
}

template <bool counting, class View>
HWY_INLINE void look_up(const LightGrid& grid, const View& view, std::span<const Ray> rays,
                        std::span<Answer> answers, TraversalCounts& counts) {
  alignas(64) float x[batch_size] = {}, y[batch_size] = {}, z[batch_size] = {};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    x[i] = rays[i].origin.x;
    y[i] = rays[i].origin.y;
    z[i] = rays[i].origin.z;
  }
  BatchPlaces seen;
  see(view, x, y, z, seen);
  InTile tiles[batch_size];
  for (std::size_t i = 0; i < rays.size(); ++i) {
    answers[i] = is_of(view, rays[i]) && holds(grid.origins, rays[i].origin) ? Answer::free
                                                                             : Answer::unknown;
    tiles[i] = in_tile(grid, seen, i);
    __builtin_prefetch(&grid.tiles[tiles[i].tile]);
  }
  Place places[batch_size];
  for (std::size_t i = 0; i < rays.size(); ++i) {
    places[i] = place_of(grid, tiles[i], seen.depth[i]);
    __builtin_prefetch(&grid.cells[places[i].cell]);
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (grid.cells[places[i].cell].count == GridCell::unknown) answers[i] = Answer::unknown;
    if (answers[i] != Answer::unknown) prefetch_list(grid, grid.cells[places[i].cell]);
  }
  Candidates<counting> candidates(grid, rays, answers, counts);
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    if (answers[i] == Answer::unknown) continue;
    const GridCell& cell = grid.cells[places[i].cell];
    if (!candidates.begin(i, grid.near_blocks.size() + cell.count)) {
      answers[i] = Answer::unknown;
      continue;
    }
    candidates.add(grid.near_blocks);
    candidates.add(cell, places[i]);
    candidates.end();
  }
  candidates.test_all();
}

template <bool counting>
void look_up_all(const LightGrid& grid, std::span<const Ray> rays, std::span<Answer> answers,
                 TraversalCounts& counts) {
  for (std::size_t first = 0; first < rays.size(); first += batch_size) {
    const std::size_t size = std::min(batch_size, rays.size() - first);
    const std::span<const Ray> batch = rays.subspan(first, size);
    const std::span<Answer> batch_answers = answers.subspan(first, size);
    if (const auto* cube = std::get_if<CubeView>(&grid.view)) {
      look_up<counting>(grid, *cube, batch, batch_answers, counts);
    } else {
      look_up<counting>(grid, std::get<ParallelView>(grid.view), batch, batch_answers, counts);
    }
  }
}

void look_up_kernel(const LightGrid& grid, std::span<const Ray> rays, std::span<Answer> answers,
                    TraversalCounts* counts) {
  TraversalCounts none;
  if (counts != nullptr) {
    look_up_all<true>(grid, rays, answers, *counts);
  } else {
    look_up_all<false>(grid, rays, answers, none);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace pah
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pah {

namespace {
HWY_EXPORT(look_up_kernel);
}  // namespace

void LightGrid::occluded(std::span<const Ray> rays, std::span<Answer> answers,
                         TraversalCounts* counts) const {
  const auto* parallel = std::get_if<ParallelView>(&view);
  if (parallel != nullptr && parallel->tangent() > 0) {
    walk(*this, *parallel, rays, answers, counts);
  } else {
    HWY_DYNAMIC_DISPATCH(look_up_kernel)(*this, rays, answers, counts);
  }
}

}  // namespace pah
#endif
