// Tests rays against the lists of cells. Kernels include it once for each instruction set.
#if defined(PAH_LIGHT_SPACE_CELL_LISTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PAH_LIGHT_SPACE_CELL_LISTS_INL
#undef PAH_LIGHT_SPACE_CELL_LISTS_INL
#else
#define PAH_LIGHT_SPACE_CELL_LISTS_INL
#endif

#include <hwy/highway.h>
#include <algorithm>

#include "bvh/block_test-inl.hpp"
#include "light_space/light_grid.hpp"

HWY_BEFORE_NAMESPACE();
namespace pah {
namespace HWY_NAMESPACE {
namespace {

using Answer = LightGrid::Answer;

// The rays of a batch wait for memory at the same time.
constexpr std::size_t batch_size = 64;

HWY_INLINE bool holds(const Aabb& box, const Vec3& p) {
  return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x &&
         p.y <= box.max.y && p.z <= box.max.z;
}

// A place in a cell, and the distance from the light.
struct Place {
  std::uint32_t cell;
  float depth;
  PlaceBytes place;  // or range of places, in the cell, with the eighth bits set
};

HWY_INLINE const std::uint32_t* list_of(const LightGrid& grid, const GridCell& cell) {
  return grid.lists.data() + std::size_t{3} * cell.first;
}

// Fetches two cache lines: most lists end within them.
HWY_INLINE void prefetch_list(const LightGrid& grid, const GridCell& cell) {
  const std::uint32_t* const list = list_of(grid, cell);
  __builtin_prefetch(list);
  __builtin_prefetch(list + 2 * std::size_t{cell.count});
}

// Appends the cell's blocks that may lie between the light and the place. Returns the new end.
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

// Collects the blocks to test for a batch of rays and prefetches them; test_all() tests them.
template <bool counting>
class Candidates {
 public:
  Candidates(const LightGrid& grid, std::span<const Ray> rays, std::span<Answer> answers,
             TraversalCounts& counts)
      : grid_(grid), rays_(rays), answers_(answers), counts_(counts) {}

  // Starts a ray that will add at most `count` blocks. Returns false if there is no room for them.
  HWY_INLINE bool begin(std::uint32_t ray, std::size_t count) {
    if (size_ + count > max_blocks || runs_size_ == batch_size) test_all();
    if (count > max_blocks) return false;
    runs_[runs_size_] = {ray, static_cast<std::uint32_t>(size_), 0};
    return true;
  }
  HWY_INLINE void add(std::span<const std::uint32_t> blocks) {
    for (const std::uint32_t block : blocks) blocks_[size_++] = block;
  }
  HWY_INLINE void add(const GridCell& cell, const Place& place) {
    if (counting) ++counts_.nodes;
    size_ = static_cast<std::size_t>(append_blocks(grid_, cell, place, blocks_ + size_) - blocks_);
  }
  HWY_INLINE void end() {
    Run& run = runs_[runs_size_];
    run.last = static_cast<std::uint32_t>(size_);
    for (std::uint32_t k = run.first; k < run.last; ++k) prefetch(grid_.bvh->blocks[blocks_[k]]);
    runs_size_ += run.last > run.first ? 1 : 0;
  }

  HWY_INLINE void test_all() {
    for (std::size_t first = 0; first < runs_size_; first += 4) {
      const auto ray = [&](std::size_t k) HWY_ATTR -> const Ray& {
        return rays_[runs_[std::min(first + k, runs_size_ - 1)].ray];
      };
      const Prepared<Float4> prepared = prepare(ray(0), ray(1), ray(2), ray(3));
      for (std::size_t k = 0; k < std::min<std::size_t>(4, runs_size_ - first); ++k)
        test(runs_[first + k], OneOfFour{prepared, k});
    }
    size_ = 0;
    runs_size_ = 0;
  }

 private:
  static constexpr std::size_t max_blocks = 1024;

  // A ray and its run of blocks.
  struct Run {
    std::uint32_t ray;
    std::uint32_t first, last;
  };

  HWY_INLINE void test(const Run& run, const OneOfFour& ray) {
    BlockHits found;
    for (std::uint32_t n = run.first; n < run.last; ++n) {
      if (counting) ++counts_.blocks;
      if (counting) counts_.triangles += TriangleBlock::width;
      if (!hits_any(ray, grid_.bvh->blocks[blocks_[n]], found)) continue;
      answers_[run.ray] = Answer::occluded;
      break;
    }
  }

  const LightGrid& grid_;
  std::span<const Ray> rays_;
  std::span<Answer> answers_;
  TraversalCounts& counts_;
  std::uint32_t blocks_[max_blocks];
  std::size_t size_ = 0;
  Run runs_[batch_size];
  std::size_t runs_size_ = 0;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace pah
HWY_AFTER_NAMESPACE();

#endif
