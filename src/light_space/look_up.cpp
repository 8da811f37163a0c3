// The kernels. This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light_space/look_up.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>
#include <algorithm>
#include <cmath>

#include "bvh/block_test-inl.hpp"
#include "light_space/light_grid.hpp"

HWY_BEFORE_NAMESPACE();
namespace pah {
namespace HWY_NAMESPACE {
namespace {

using Answer = LightGrid::Answer;

// Rays whose look-ups wait for memory at the same time.
constexpr std::size_t batch_size = 64;
constexpr std::size_t most_blocks = 1024;

// Where the light sees the origins of a batch, in loops that are compiled to vectors.
struct Seen {
  alignas(64) float u[batch_size], v[batch_size], depth[batch_size];
  alignas(64) std::int32_t face[batch_size];
};

HWY_INLINE void see(const CubeView& view, const float (&x)[batch_size],
                    const float (&y)[batch_size], const float (&z)[batch_size], Seen& seen) {
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
                    const float (&y)[batch_size], const float (&z)[batch_size], Seen& seen) {
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

HWY_INLINE bool is_of(const CubeView& view, const Ray& ray) {
  return ray.t_max <= 1 && view.eye() - ray.origin == ray.direction;
}
HWY_INLINE bool is_of(const ParallelView& view, const Ray& ray) {
  return ray.direction == view.toward();
}

HWY_INLINE bool holds(const Aabb& box, const Vec3& p) {
  return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x &&
         p.y <= box.max.y && p.z <= box.max.z;
}

// Where a ray's origin is in the grid.
struct Place {
  std::uint32_t cell;
  float depth;
  PlaceBytes place;  // in the cell, with the eighth bits
};

HWY_INLINE Place place_of(const LightGrid& grid, const Seen& seen, std::size_t i) {
  constexpr std::uint32_t places = GridFace::places;
  const GridFace& face = grid.faces[static_cast<std::size_t>(seen.face[i])];
  const float u = (seen.u[i] - face.u) * face.per_length;
  const float v = (seen.v[i] - face.v) * face.per_length;
  const bool inside = u >= 0 && v >= 0 && u < static_cast<float>(face.columns * places) &&
                      v < static_cast<float>(face.rows * places);
  if (!inside) return {static_cast<std::uint32_t>(grid.cells.size() - 1), 0, 0};
  const auto place_u = static_cast<std::uint32_t>(static_cast<std::int32_t>(u));
  const auto place_v = static_cast<std::uint32_t>(static_cast<std::int32_t>(v));
  const std::uint32_t u_in = place_u % places, v_in = place_v % places;
  return {face.first_cell + place_v / places * face.columns + place_u / places, seen.depth[i],
          place_bytes(u_in, u_in, v_in, v_in) | eighth_bits};
}

HWY_INLINE const std::uint32_t* list_of(const LightGrid& grid, const GridCell& cell) {
  return grid.lists.data() + std::size_t{3} * cell.first;
}

// Appends the blocks of a cell that may be between the light and a place.
HWY_INLINE std::uint32_t* append_blocks(const LightGrid& grid, const GridCell& cell,
                                        const Place& place, std::uint32_t* HWY_RESTRICT blocks) {
  const hn::CappedTag<float, LightGrid::read_beyond> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const std::uint32_t* const depths = list_of(grid, cell);
  const std::uint32_t* const places = depths + cell.count;
  const std::uint32_t* const numbers = places + cell.count;
  const auto depth = hn::Set(d, place.depth);
  const auto own = hn::Set(du, place.place);
  const auto eighth = hn::Set(du, eighth_bits);
  for (std::uint32_t first = 0; first < cell.count; first += hn::Lanes(d)) {
    const auto nearer = hn::Le(hn::BitCast(d, hn::LoadU(du, depths + first)), depth);
    const auto held = hn::And(hn::Sub(own, hn::LoadU(du, places + first)), eighth);
    std::uint32_t found = bits(d, hn::And(nearer, hn::RebindMask(d, hn::Eq(held, eighth))));
    const std::uint32_t left = cell.count - first;
    if (left < hn::Lanes(d)) found &= (1U << left) - 1;
    for (; found != 0; found &= found - 1) *blocks++ = numbers[first + lowest_bit(found)];
    if (!hn::AllTrue(d, nearer)) break;
  }
  return blocks;
}

HWY_INLINE void prefetch(const TriangleBlock& block) {
  const auto* const bytes = reinterpret_cast<const char*>(&block);
  __builtin_prefetch(bytes);
  __builtin_prefetch(bytes + 64);
  __builtin_prefetch(bytes + 128);
}

// A ray and its run in the list of blocks.
struct Asked {
  std::uint32_t ray;
  std::uint32_t first, last;
};

template <bool counting>
HWY_INLINE void test(const LightGrid& grid, std::span<const Ray> rays, std::span<const Asked> asked,
                     const std::uint32_t* blocks, std::span<Answer> answers,
                     TraversalCounts& counts) {
  for (std::size_t first = 0; first < asked.size(); first += 4) {
    const auto ray = [&](std::size_t k) HWY_ATTR -> const Ray& {
      return rays[asked[std::min(first + k, asked.size() - 1)].ray];
    };
    const Prepared<Float4> prepared = prepare(ray(0), ray(1), ray(2), ray(3));
    for (std::size_t k = 0; k < std::min<std::size_t>(4, asked.size() - first); ++k) {
      const Asked& one = asked[first + k];
      BlockHits found;
      for (std::uint32_t n = one.first; n < one.last; ++n) {
        const TriangleBlock& block = grid.bvh->blocks[blocks[n]];
        if (counting) ++counts.blocks;
        if (counting) counts.triangles += TriangleBlock::width;
        if (!hits_any(OneOfFour{prepared, k}, block, found)) continue;
        answers[one.ray] = Answer::occluded;
        break;
      }
    }
  }
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
  Seen seen;
  see(view, x, y, z, seen);
  Place places[batch_size];
  for (std::size_t i = 0; i < rays.size(); ++i) {
    answers[i] = is_of(view, rays[i]) && holds(grid.origins, rays[i].origin) ? Answer::free
                                                                             : Answer::unknown;
    places[i] = place_of(grid, seen, i);
    __builtin_prefetch(&grid.cells[places[i].cell]);
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (grid.cells[places[i].cell].count == GridCell::unknown) answers[i] = Answer::unknown;
    if (answers[i] != Answer::unknown)
      __builtin_prefetch(list_of(grid, grid.cells[places[i].cell]));
  }
  // What there is to test, ray by ray.
  std::uint32_t blocks[most_blocks];
  std::size_t found_blocks = 0;
  Asked asked[batch_size];
  std::size_t count = 0;
  const auto test_all = [&]() HWY_ATTR {
    test<counting>(grid, rays, std::span(asked, count), blocks, answers, counts);
    found_blocks = 0;
    count = 0;
  };
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    if (answers[i] == Answer::unknown) continue;
    const Place place = places[i];
    const GridCell& cell = grid.cells[place.cell];
    if (counting) ++counts.nodes;
    if (found_blocks + grid.near_blocks.size() + cell.count > most_blocks) test_all();
    if (grid.near_blocks.size() + cell.count > most_blocks) {
      answers[i] = Answer::unknown;
      continue;
    }
    const auto first = static_cast<std::uint32_t>(found_blocks);
    for (const std::uint32_t block : grid.near_blocks) blocks[found_blocks++] = block;
    found_blocks =
        static_cast<std::size_t>(append_blocks(grid, cell, place, blocks + found_blocks) - blocks);
    for (std::size_t k = first; k < found_blocks; ++k) prefetch(grid.bvh->blocks[blocks[k]]);
    asked[count] = {i, first, static_cast<std::uint32_t>(found_blocks)};
    count += found_blocks > first ? 1 : 0;
  }
  test_all();
}

template <bool counting>
void look_up_all(const LightGrid& grid, std::span<const Ray> rays, std::span<Answer> answers,
                 TraversalCounts& counts) {
  for (std::size_t first = 0; first < rays.size(); first += batch_size) {
    const std::size_t size = std::min(batch_size, rays.size() - first);
    const std::span<const Ray> some = rays.subspan(first, size);
    const std::span<Answer> theirs = answers.subspan(first, size);
    if (const auto* cube = std::get_if<CubeView>(&grid.view)) {
      look_up<counting>(grid, *cube, some, theirs, counts);
    } else {
      look_up<counting>(grid, std::get<ParallelView>(grid.view), some, theirs, counts);
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
  HWY_DYNAMIC_DISPATCH(look_up_kernel)(*this, rays, answers, counts);
}

}  // namespace pah
#endif
