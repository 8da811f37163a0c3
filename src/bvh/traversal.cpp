// The kernels. This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/traversal.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>
#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "bvh/bvh.hpp"
#include "geometry/ray_triangle.hpp"

HWY_BEFORE_NAMESPACE();
namespace pah {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Bit i of the result: lane i of the mask.
template <class D, class M>
HWY_INLINE std::uint32_t bits(D d, M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0];
}

// A ray where it was prepared, beside three others.
struct OneOfFour {
  const Prepared<Float4>& four;
  std::size_t k;

  [[nodiscard]] float t_max() const { return four.t_max[k]; }
};

// A ray as nodes are tested with it (ray_box.hpp).
struct NodeRay {
  using D = hn::CappedTag<float, BvhNode::width>;
  hn::Vec<D> inverse[3];
  hn::Vec<D> near_offset[3];
  hn::Vec<D> far_offset[3];
  std::size_t near_planes[3];  // where in a node, in floats
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

  // Which children's intervals the ray meets within [0, limit]; `near` is where they start.
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

// The shared rule as it stands, for what the block's test leaves to it. Seldom called: kept out of
// the loops, whose registers it would take.
HWY_NOINLINE bool decide(const OneOfFour& ray, const TriangleBlock& block, std::size_t lane,
                         float limit, TriangleHit& hit) {
  return intersect_triangle(extracted(ray.four, ray.k), block.triangle(lane), limit, hit);
}

// What is found of triangles side by side.
struct BlockHits {
  HWY_ALIGN float t[TriangleBlock::width];
  HWY_ALIGN float u[TriangleBlock::width];
  HWY_ALIGN float v[TriangleBlock::width];
  std::uint32_t known = 0;  // bit i: triangle i is hit at t; else the rule is to be asked

  HWY_INLINE bool accept(const OneOfFour& ray, const TriangleBlock& block, std::size_t lane,
                         float limit, TriangleHit& hit) const {
    if ((known >> lane & 1U) == 0) return decide(ray, block, lane, limit, hit);
    hit = {t[lane], u[lane], v[lane]};
    return hit.t <= limit;
  }
};

// Triangles side by side, by the formulas of ray_triangle.hpp.
using TriangleLanes = hn::CappedTag<float, TriangleBlock::width>;
using TriangleVec = hn::Vec<TriangleLanes>;

HWY_INLINE TriangleVec least(const TriangleVec (&v)[3]) {
  return hn::Min(hn::Min(v[0], v[1]), v[2]);
}
HWY_INLINE TriangleVec largest(const TriangleVec (&v)[3]) {
  return hn::Max(hn::Max(v[0], v[1]), v[2]);
}
HWY_INLINE TriangleVec largest_size(const TriangleVec (&v)[3]) {
  return hn::Max(hn::Max(hn::Abs(v[0]), hn::Abs(v[1])), hn::Abs(v[2]));
}

// Which triangles are hit within the limit, or may be.
HWY_INLINE std::uint32_t maybe_hit(const OneOfFour& ray, const TriangleBlock& block, float limit,
                                   BlockHits& found) {
  const TriangleLanes d;
  const auto& [four, i] = ray;
  const auto z_axis = static_cast<std::size_t>(four.z_axis[i]);
  const std::size_t x_axis = next_axis[z_axis];
  const std::size_t axes[3] = {x_axis * TriangleBlock::width,
                               next_axis[x_axis] * TriangleBlock::width,
                               z_axis * TriangleBlock::width};
  const TriangleVec origin[3] = {hn::Set(d, four.origin[0][i]), hn::Set(d, four.origin[1][i]),
                                 hn::Set(d, four.origin[2][i])};
  const TriangleVec shear[2] = {hn::Set(d, four.shear_x[i]), hn::Set(d, four.shear_y[i])};
  std::uint32_t hits = 0;
  found.known = 0;
  for (std::size_t lane = 0; lane < TriangleBlock::width; lane += hn::Lanes(d)) {
    TriangleVec x[3];
    TriangleVec y[3];
    TriangleVec z[3];
    for (int k = 0; k < 3; ++k) {
      const float* vertex = block.vertices[k][0] + lane;
      z[k] = hn::Sub(hn::Load(d, vertex + axes[2]), origin[2]);
      x[k] = hn::Sub(hn::Sub(hn::Load(d, vertex + axes[0]), origin[0]), hn::Mul(shear[0], z[k]));
      y[k] = hn::Sub(hn::Sub(hn::Load(d, vertex + axes[1]), origin[1]), hn::Mul(shear[1], z[k]));
    }
    const TriangleVec e[3] = {hn::Sub(hn::Mul(x[2], y[1]), hn::Mul(y[2], x[1])),
                              hn::Sub(hn::Mul(x[0], y[2]), hn::Mul(y[0], x[2])),
                              hn::Sub(hn::Mul(x[1], y[0]), hn::Mul(y[1], x[0]))};
    const auto mixed = hn::And(hn::Lt(least(e), hn::Zero(d)), hn::Gt(largest(e), hn::Zero(d)));
    if (hn::AllTrue(d, mixed)) continue;

    const TriangleVec one = hn::Set(d, 1.0F);
    const TriangleVec determinant = hn::Add(hn::Add(e[0], e[1]), e[2]);
    const TriangleVec inverse = hn::Div(one, determinant);
    const TriangleVec scale = hn::Set(d, four.scale_z[i]);
    TriangleVec depth[3];
    TriangleVec weight[3];
    for (int k = 0; k < 3; ++k) {
      depth[k] = hn::Mul(z[k], scale);
      weight[k] = hn::Min(hn::Mul(e[k], inverse), one);
    }
    const TriangleVec t =
        hn::Add(hn::Add(hn::Mul(weight[0], depth[0]), hn::Mul(weight[1], depth[1])),
                hn::Mul(weight[2], depth[2]));
    const TriangleVec nearest = least(depth);
    const TriangleVec farthest = largest(depth);
    const TriangleVec most_depth = hn::Max(hn::Abs(nearest), hn::Abs(farthest));
    const TriangleVec most_x = largest_size(x);
    const TriangleVec most_y = largest_size(y);
    const TriangleVec size = hn::Abs(determinant);
    const TriangleVec inverse_size = hn::Abs(inverse);
    const TriangleVec error =
        hn::Mul(hn::Mul(hn::Mul(most_x, inverse_size), most_y), hn::Sub(farthest, nearest));
    const auto in_range = hn::And(hn::Ge(size, hn::Set(d, detail::least_determinant)),
                                  hn::Le(size, hn::Set(d, detail::most_determinant)));
    const auto without_zero = hn::Ne(hn::Mul(hn::Mul(e[0], e[1]), e[2]), hn::Zero(d));
    const auto well_conditioned =
        hn::And(hn::And(in_range, without_zero), hn::Le(error, hn::Add(most_depth, most_depth)));
    // Most rays start next to a triangle that is just behind them.
    const auto meets = hn::And(hn::Gt(t, hn::Zero(d)), hn::Le(t, hn::Set(d, limit)));
    auto candidates = hn::AndNot(mixed, hn::Or(meets, hn::Not(well_conditioned)));
    if (hn::AllFalse(d, candidates)) continue;

    const auto beside = hn::And(well_conditioned, hn::Le(nearest, hn::Zero(d)));
    if (!hn::AllFalse(d, hn::And(candidates, beside))) {
      const TriangleVec bound = hn::Set(d, rounding_bound(5));
      const TriangleVec most_z = largest_size(z);
      const TriangleVec error_x = hn::Mul(bound, hn::Add(most_x, most_z));
      const TriangleVec error_y = hn::Mul(bound, hn::Add(most_y, most_z));
      const TriangleVec product = hn::Mul(hn::Mul(hn::Set(d, rounding_bound(2)), most_x), most_y);
      const TriangleVec half_error_edge =
          hn::Add(product, hn::Add(hn::Mul(error_y, most_x), hn::Mul(error_x, most_y)));
      const TriangleVec error_t = hn::Add(hn::Mul(hn::Set(d, rounding_bound(12)), largest_size(e)),
                                          hn::Mul(hn::Set(d, 2.0F), half_error_edge));
      const TriangleVec distance_error =
          hn::Mul(hn::Mul(hn::Mul(hn::Set(d, 3.0F), error_t), inverse_size), most_depth);
      candidates = hn::AndNot(hn::And(beside, hn::Le(t, distance_error)), candidates);
    }
    hits |= bits(d, candidates) << lane;
    found.known |= bits(d, well_conditioned) << lane;
    hn::Store(t, d, found.t + lane);
    hn::Store(weight[1], d, found.u + lane);
    hn::Store(weight[2], d, found.v + lane);
  }
  return hits;
}

// A child that waits, as a number: those that are nearer are less.
class Entry {
 public:
  Entry() = default;  // without a value: stacks hold hundreds
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

// Without a branch, which nobody could predict.
HWY_INLINE void order(Entry& nearer, Entry& farther) {
  const Entry a = nearer;
  const Entry b = farther;
  nearer = std::min(a, b);
  farther = std::max(a, b);
}

// Enough for a path to the deepest leaf with all siblings waiting.
inline constexpr std::size_t stack_size = (BvhNode::width - 1) * max_depth + BvhNode::width;

HWY_INLINE std::uint32_t lowest_bit(std::uint32_t mask) {
  return static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(mask));
}

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
        // Goes on with the nearest; the others wait, the nearest of them on top.
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
    // Equal distance is visited: a lower index may win there.
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
        TriangleHit hit;
        for (std::uint32_t hits = maybe_hit(ray, *block, ray.t_max(), found); hits != 0;
             hits &= hits - 1) {
          if (found.accept(ray, *block, lowest_bit(hits), ray.t_max(), hit)) return true;
        }
      }
    }
  }
  return false;
}

// Calls `trace(ray, i)` for every ray. They are prepared some at a time, all divisions of which
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
