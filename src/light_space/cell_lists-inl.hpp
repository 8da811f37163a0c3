// Lists of cells against rays, for kernels: included once for each instruction set.
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

// Rays whose look-ups wait for memory at the same time.
constexpr std::size_t batch_size = 64;

HWY_INLINE bool holds(const Aabb& box, const Vec3& p) {
  return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x &&
         p.y <= box.max.y && p.z <= box.max.z;
}

// Where a ray is in a cell, and how far from the light.
struct Place {
  std::uint32_t cell;
  float depth;
  PlaceBytes place;  // or places, in the cell, with the eighth bits
};

HWY_INLINE const std::uint32_t* list_of(const LightGrid& grid, const GridCell& cell) {
  return grid.lists.data() + std::size_t{3} * cell.first;
}

// Short lists, as most are, end on the second of these lines.
HWY_INLINE void prefetch_list(const LightGrid& grid, const GridCell& cell) {
  const std::uint32_t* const list = list_of(grid, cell);
  __builtin_prefetch(list);
  __builtin_prefetch(list + 2 * std::size_t{cell.count});
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

// Blocks to be tested, ray by ray, once all of them are on their way from memory.
template <bool counting>
class Candidates {
 public:
  Candidates(const LightGrid& grid, std::span<const Ray> rays, std::span<Answer> answers,
             TraversalCounts& counts)
      : grid_(grid), rays_(rays), answers_(answers), counts_(counts) {}

  // From now on blocks are a ray's, of which there will be so many at most: false if they have no
  // room.
  HWY_INLINE bool begin(std::uint32_t ray, std::size_t most) {
    if (size_ + most > most_blocks || asked_size_ == batch_size) test_all();
    if (most > most_blocks) return false;
    asked_[asked_size_] = {ray, static_cast<std::uint32_t>(size_), 0};
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
    Asked& asked = asked_[asked_size_];
    asked.last = static_cast<std::uint32_t>(size_);
    for (std::uint32_t k = asked.first; k < asked.last; ++k)
      prefetch(grid_.bvh->blocks[blocks_[k]]);
    asked_size_ += asked.last > asked.first ? 1 : 0;
  }

  HWY_INLINE void test_all() {
    for (std::size_t first = 0; first < asked_size_; first += 4) {
      const auto ray = [&](std::size_t k) HWY_ATTR -> const Ray& {
        return rays_[asked_[std::min(first + k, asked_size_ - 1)].ray];
      };
      const Prepared<Float4> prepared = prepare(ray(0), ray(1), ray(2), ray(3));
      for (std::size_t k = 0; k < std::min<std::size_t>(4, asked_size_ - first); ++k)
        test(asked_[first + k], OneOfFour{prepared, k});
    }
    size_ = 0;
    asked_size_ = 0;
  }

 private:
  static constexpr std::size_t most_blocks = 1024;

  // A ray and its run of blocks.
  struct Asked {
    std::uint32_t ray;
    std::uint32_t first, last;
  };

  HWY_INLINE void test(const Asked& asked, const OneOfFour& ray) {
    BlockHits found;
    for (std::uint32_t n = asked.first; n < asked.last; ++n) {
      if (counting) ++counts_.blocks;
      if (counting) counts_.triangles += TriangleBlock::width;
      if (!hits_any(ray, grid_.bvh->blocks[blocks_[n]], found)) continue;
      answers_[asked.ray] = Answer::occluded;
      break;
    }
  }

  const LightGrid& grid_;
  std::span<const Ray> rays_;
  std::span<Answer> answers_;
  TraversalCounts& counts_;
  std::uint32_t blocks_[most_blocks];
  std::size_t size_ = 0;
  Asked asked_[batch_size];
  std::size_t asked_size_ = 0;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace pah
HWY_AFTER_NAMESPACE();

#endif
