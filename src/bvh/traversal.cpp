// The traversal kernels. Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/traversal.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>
#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "bvh/block_test-inl.hpp"
#include "bvh/bvh.hpp"

HWY_BEFORE_NAMESPACE();
namespace pah {
namespace HWY_NAMESPACE {
namespace {

// A ray prepared for the slab test of eight boxes (ray_box.hpp).
struct NodeRay {
  using D = hn::CappedTag<float, BvhNode::width>;
  hn::Vec<D> inverse[3];
  hn::Vec<D> near_offset[3];
  hn::Vec<D> far_offset[3];
  std::size_t near_planes[3];  // offsets into a node's planes, in floats
  std::size_t far_planes[3];

  HWY_INLINE explicit NodeRay(const OneOfFour& ray) {
    const D d;
    for (int axis = 0; axis < 3; ++axis) {
      inverse[axis] = hn::Set(d, ray.four.inverse[axis][ray.k]);
      near_offset[axis] = hn::Set(d, ray.four.near_offset[axis][ray.k]);
      far_offset[axis] = hn::Set(d, ray.four.far_offset[axis][ray.k]);
      const std::size_t planes = 2 * static_cast<std::size_t>(axis) * BvhNode::width;
      const std::size_t upper = std::bit_cast<std::uint32_t>(ray.four.inverse[axis][ray.k]) >> 31U;
      near_planes[axis] = planes + upper * BvhNode::width;
      far_planes[axis] = planes + (1 - upper) * BvhNode::width;
    }
  }

  // Bit k is set if the ray meets child k within [0, limit]; near[k] is where it enters.
  HWY_INLINE std::uint32_t meet_children(const BvhNode& node, float limit,
                                         float* HWY_RESTRICT near) const {
    const D d;
    const float* planes = node.planes[0][0];
    std::uint32_t hits = 0;
    for (std::size_t lane = 0; lane < BvhNode::width; lane += hn::Lanes(d)) {
      const auto start_of = [&](int axis) HWY_ATTR {
        return hn::MulAdd(hn::Load(d, planes + near_planes[axis] + lane), inverse[axis],
                          near_offset[axis]);
      };
      const auto end_of = [&](int axis) HWY_ATTR {
        return hn::MulAdd(hn::Load(d, planes + far_planes[axis] + lane), inverse[axis],
                          far_offset[axis]);
      };
      const auto start =
          hn::Max(hn::Max(start_of(0), start_of(1)), hn::Max(start_of(2), hn::Zero(d)));
      const auto end =
          hn::Min(hn::Min(end_of(0), end_of(1)), hn::Min(end_of(2), hn::Set(d, limit)));
      hn::Store(start, d, near + lane);
      hits |= bits(d, hn::Le(start, end)) << lane;
    }
    return hits;
  }
};

// A child on the stack, packed into an integer that compares by distance.
class Entry {
 public:
  Entry() = default;  // not initialized: stacks hold hundreds
  Entry(float near, ChildRef child)
      : bits_(std::uint64_t{std::bit_cast<std::uint32_t>(near)} << 32U |
              std::bit_cast<std::uint32_t>(child)) {}
  [[nodiscard]] float near() const {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits_ >> 32U));
  }
  [[nodiscard]] ChildRef child() const {
    return std::bit_cast<ChildRef>(static_cast<std::uint32_t>(bits_));
  }
  friend bool operator<(Entry a, Entry b) { return a.bits_ < b.bits_; }

 private:
  std::uint64_t bits_;
};

// Branch-free: the branch would be unpredictable.
HWY_INLINE void order(Entry& nearer, Entry& farther) {
  const Entry a = nearer;
  const Entry b = farther;
  nearer = std::min(a, b);
  farther = std::max(a, b);
}

// Enough for a path to the deepest leaf with all siblings on the stack.
inline constexpr std::size_t stack_size = (BvhNode::width - 1) * max_depth + BvhNode::width;

template <bool counting>
HWY_INLINE void closest(const Bvh& bvh, const OneOfFour& ray, Hit& best, TraversalCounts& counts) {
  const NodeRay nodes(ray);
  BlockHits found;
  HWY_ALIGN float near[BvhNode::width];
  Entry stack[stack_size];
  Entry* top = stack;
  ChildRef current = ChildRef::inner(0);
  for (;;) {
    if (counting) ++counts.nodes;
    if (!current.is_leaf()) {
      if (counting) ++counts.inner_nodes;
      const BvhNode& node = bvh.nodes[current.node()];
      std::uint32_t hits = nodes.meet_children(node, best.t, near);
      if (hits != 0) {
        // Continues with the nearest child and pushes the others, the nearest of them last.
        const auto first_of = [&](std::uint32_t children) {
          const std::uint32_t k = lowest_bit(children);
          return Entry(near[k], node.children[k]);
        };
        const std::uint32_t first = lowest_bit(hits);
        const std::uint32_t others = hits & (hits - 1);
        if (others == 0) {
          current = node.children[first];
          continue;
        }
        Entry nearest(near[first], node.children[first]);
        hits = others;
        Entry second = first_of(hits);
        hits &= hits - 1;
        order(nearest, second);
        if (hits == 0) {
          *top++ = second;
        } else {
          Entry third = first_of(hits);
          hits &= hits - 1;
          order(second, third);
          order(nearest, second);
          Entry* const bottom = top;
          *top++ = third;
          *top++ = second;
          for (; hits != 0; hits &= hits - 1) {
            Entry entry = first_of(hits);
            order(nearest, entry);
            Entry* place = top++;
            for (; place > bottom && place[-1] < entry; --place) *place = place[-1];
            *place = entry;
          }
        }
        current = nearest.child();
        continue;
      }
    } else {
      const std::uint32_t count = current.triangles();
      if (counting) counts.triangles += count;
      const TriangleBlock* block = &bvh.blocks[current.first_block()];
      for (std::uint32_t begin = 0; begin < count; begin += TriangleBlock::width, ++block) {
        if (counting) ++counts.blocks;
        for (std::uint32_t hits = maybe_hit(ray, *block, best.t, found); hits != 0;
             hits &= hits - 1) {
          const std::uint32_t lane = lowest_bit(hits);
          TriangleHit hit;
          if (found.accept(ray, *block, lane, best.t, hit))
            keep_nearer(hit, block->indices[lane], best);
        }
      }
    }
    // A node at an equal distance is visited: a lower index may win there.
    do {
      if (top == stack) return;
      --top;
    } while (top->near() > best.t);
    current = top->child();
  }
}

template <bool counting>
HWY_INLINE bool any(const Bvh& bvh, const OneOfFour& ray, TraversalCounts& counts) {
  const NodeRay nodes(ray);
  BlockHits found;
  HWY_ALIGN float near[BvhNode::width];
  std::uint32_t stack[stack_size];
  std::uint32_t* top = stack;
  *top++ = 0;
  while (top != stack) {
    const BvhNode& node = bvh.nodes[*--top];
    if (counting) ++counts.nodes;
    if (counting) ++counts.inner_nodes;
    for (std::uint32_t met = nodes.meet_children(node, ray.t_max(), near); met != 0;
         met &= met - 1) {
      const ChildRef child = node.children[lowest_bit(met)];
      if (!child.is_leaf()) {
        *top++ = child.node();
        continue;
      }
      const std::uint32_t count = child.triangles();
      if (counting) ++counts.nodes;
      if (counting) counts.triangles += count;
      const TriangleBlock* block = &bvh.blocks[child.first_block()];
      for (std::uint32_t begin = 0; begin < count; begin += TriangleBlock::width, ++block) {
        if (counting) ++counts.blocks;
        if (hits_any(ray, *block, found)) return true;
      }
    }
  }
  return false;
}

// Calls `trace(ray, i)` for every ray. Rays are prepared 16 at a time, so that their divisions
// overlap.
template <class Trace>
HWY_INLINE void for_each_prepared(std::span<const Ray> rays, const Trace& trace) {
  constexpr std::size_t at_a_time = 16;
  Prepared<Float4> prepared[at_a_time / 4];
  for (std::size_t first = 0; first < rays.size(); first += at_a_time) {
    const std::size_t count = std::min(at_a_time, rays.size() - first);
    const auto ray = [&](std::size_t i)
                         HWY_ATTR -> const Ray& { return rays[first + std::min(i, count - 1)]; };
    for (std::size_t i = 0; i < count; i += 4)
      prepared[i / 4] = prepare(ray(i), ray(i + 1), ray(i + 2), ray(i + 3));
    for (std::size_t i = 0; i < count; ++i) trace(OneOfFour{prepared[i / 4], i % 4}, first + i);
  }
}

template <bool counting>
void closest_batch(const Bvh& bvh, std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts& counts) {
  for_each_prepared(rays, [&](const OneOfFour& ray, std::size_t i) HWY_ATTR {
    Hit best = nothing_yet(ray.t_max());
    closest<counting>(bvh, ray, best, counts);
    hits[i] = finished(best);
  });
}

template <bool counting>
void any_batch(const Bvh& bvh, std::span<const Ray> rays, std::span<std::uint8_t> results,
               TraversalCounts& counts) {
  for_each_prepared(rays, [&](const OneOfFour& ray, std::size_t i)
                              HWY_ATTR { results[i] = any<counting>(bvh, ray, counts) ? 1 : 0; });
}

void closest_kernel(const Bvh& bvh, std::span<const Ray> rays, std::span<Hit> hits,
                    TraversalCounts* counts) {
  TraversalCounts none;
  if (counts != nullptr) {
    closest_batch<true>(bvh, rays, hits, *counts);
  } else {
    closest_batch<false>(bvh, rays, hits, none);
  }
}

void any_kernel(const Bvh& bvh, std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) {
  TraversalCounts none;
  if (counts != nullptr) {
    any_batch<true>(bvh, rays, results, *counts);
  } else {
    any_batch<false>(bvh, rays, results, none);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace pah
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pah {

namespace {
HWY_EXPORT(closest_kernel);
HWY_EXPORT(any_kernel);
}  // namespace

void closest_hits(const Bvh& bvh, std::span<const Ray> rays, std::span<Hit> hits,
                  TraversalCounts* counts) {
  if (bvh.nodes.empty()) {
    std::fill_n(hits.begin(), rays.size(), Hit{});
    return;
  }
  HWY_DYNAMIC_DISPATCH(closest_kernel)(bvh, rays, hits, counts);
}

void occluded(const Bvh& bvh, std::span<const Ray> rays, std::span<std::uint8_t> results,
              TraversalCounts* counts) {
  if (bvh.nodes.empty()) {
    std::fill_n(results.begin(), rays.size(), std::uint8_t{0});
    return;
  }
  HWY_DYNAMIC_DISPATCH(any_kernel)(bvh, rays, results, counts);
}

}  // namespace pah
#endif
