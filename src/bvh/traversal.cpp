// The kernels. This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/traversal.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/cache_control.h>
#include <hwy/highway.h>
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

// What the slab test needs of a ray, held in registers while it is traversed.
struct SlabRay {
  using D = hn::CappedTag<float, BvhNode::width>;
  hn::Vec<D> inverse[3];
  hn::Vec<D> near_origin[3];
  hn::Vec<D> far_origin[3];
  std::size_t near_planes[3];  // where in a node, in floats
  std::size_t far_planes[3];

  HWY_INLINE explicit SlabRay(const PreparedRay& ray) {
    const D d;
    for (int axis = 0; axis < 3; ++axis) {
      inverse[axis] = hn::Set(d, ray.inverse[axis]);
      near_origin[axis] = hn::Set(d, ray.near_origin[axis]);
      far_origin[axis] = hn::Set(d, ray.far_origin[axis]);
      const std::size_t plane = 2 * static_cast<std::size_t>(axis);
      near_planes[axis] = (plane + ray.negative[axis]) * BvhNode::width;
      far_planes[axis] = (plane + 1 - ray.negative[axis]) * BvhNode::width;
    }
  }

  // Which children's intervals the ray meets within [0, limit]; `near` is where they start.
  HWY_INLINE std::uint32_t meet_children(const BvhNode& node, float limit,
                                         float* HWY_RESTRICT near) const {
    const D d;
    const float* planes = node.planes[0][0];
    std::uint32_t hits = 0;
    for (std::size_t lane = 0; lane < BvhNode::width; lane += hn::Lanes(d)) {
      auto start = hn::Zero(d);
      auto end = hn::Set(d, limit);
      for (int axis = 0; axis < 3; ++axis) {
        const auto near_plane = hn::Load(d, planes + near_planes[axis] + lane);
        const auto far_plane = hn::Load(d, planes + far_planes[axis] + lane);
        start = hn::Max(start, hn::Mul(hn::Sub(near_plane, near_origin[axis]), inverse[axis]));
        end = hn::Min(end, hn::Mul(hn::Sub(far_plane, far_origin[axis]), inverse[axis]));
      }
      hn::Store(start, d, near + lane);
      hits |= bits(d, hn::Le(start, end)) << lane;
    }
    return hits;
  }
};

// Which triangles pass the signs of the edge functions: the formulas of ray_triangle.hpp, side by
// side. Survivors are few, and the shared rule decides them.
HWY_INLINE std::uint32_t maybe_hit(const TriangleBlock& block, const PreparedRay& ray) {
  const hn::CappedTag<float, TriangleBlock::width> d;
  const auto x = ray.axes[0];
  const auto y = ray.axes[1];
  const auto z = ray.axes[2];
  const auto origin_x = hn::Set(d, ray.origin[x]);
  const auto origin_y = hn::Set(d, ray.origin[y]);
  const auto origin_z = hn::Set(d, ray.origin[z]);
  const auto shear_x = hn::Set(d, ray.shear_x);
  const auto shear_y = hn::Set(d, ray.shear_y);
  const auto zero = hn::Zero(d);
  std::uint32_t hits = 0;
  for (std::size_t lane = 0; lane < TriangleBlock::width; lane += hn::Lanes(d)) {
    const auto& v = block.vertices;
    const auto sheared = [&](const float* plane, const float* depth, auto origin,
                             auto shear) HWY_ATTR {
      return hn::Sub(hn::Sub(hn::Load(d, plane + lane), origin),
                     hn::Mul(shear, hn::Sub(hn::Load(d, depth + lane), origin_z)));
    };
    const auto px = sheared(v[0][x], v[0][z], origin_x, shear_x);
    const auto py = sheared(v[0][y], v[0][z], origin_y, shear_y);
    const auto qx = sheared(v[1][x], v[1][z], origin_x, shear_x);
    const auto qy = sheared(v[1][y], v[1][z], origin_y, shear_y);
    const auto rx = sheared(v[2][x], v[2][z], origin_x, shear_x);
    const auto ry = sheared(v[2][y], v[2][z], origin_y, shear_y);
    const auto a = hn::Sub(hn::Mul(rx, qy), hn::Mul(ry, qx));
    const auto b = hn::Sub(hn::Mul(px, ry), hn::Mul(py, rx));
    const auto c = hn::Sub(hn::Mul(qx, py), hn::Mul(qy, px));
    const auto some_below = hn::Or(hn::Or(hn::Lt(a, zero), hn::Lt(b, zero)), hn::Lt(c, zero));
    const auto some_above = hn::Or(hn::Or(hn::Gt(a, zero), hn::Gt(b, zero)), hn::Gt(c, zero));
    hits |= bits(d, hn::Not(hn::And(some_below, some_above))) << lane;
  }
  return hits;
}

struct Entry {
  ChildRef child;
  float near;
};

// Enough for a path to the deepest leaf with all siblings waiting.
inline constexpr std::size_t stack_size = (BvhNode::width - 1) * max_depth + BvhNode::width;

HWY_INLINE std::uint32_t lowest_bit(std::uint32_t mask) {
  return static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(mask));
}

HWY_INLINE void prefetch(const Bvh& bvh, ChildRef child) {
  if (child.is_leaf()) {
    const TriangleBlock* block = bvh.blocks.data() + child.first_block();
    hwy::Prefetch(block->vertices[0]);
    hwy::Prefetch(block->vertices[1] + 1);
    hwy::Prefetch(block->indices);
  } else {
    const BvhNode* node = bvh.nodes.data() + child.node();
    for (const auto& planes : node->planes) hwy::Prefetch(planes);
    hwy::Prefetch(node->children);
  }
}

template <bool counting>
HWY_INLINE void closest(const Bvh& bvh, const PreparedRay& ray, Hit& best,
                        TraversalCounts& counts) {
  const SlabRay slabs(ray);
  HWY_ALIGN float near[BvhNode::width];
  Entry stack[stack_size];
  Entry* top = stack;
  ChildRef current = ChildRef::inner(0);
  for (;;) {
    if (counting) ++counts.nodes;
    if (!current.is_leaf()) {
      if (counting) ++counts.inner_nodes;
      const BvhNode& node = bvh.nodes[current.node()];
      std::uint32_t hits = slabs.meet_children(node, best.t, near);
      if (hits != 0) {
        // Goes on with the nearest; the others wait, the nearest of them on top.
        std::uint32_t k = lowest_bit(hits);
        Entry nearest{node.children[k], near[k]};
        prefetch(bvh, nearest.child);
        Entry* const bottom = top;
        for (hits &= hits - 1; hits != 0; hits &= hits - 1) {
          k = lowest_bit(hits);
          Entry entry{node.children[k], near[k]};
          prefetch(bvh, entry.child);
          if (entry.near < nearest.near) std::swap(entry, nearest);
          Entry* place = top++;
          for (; place > bottom && place[-1].near < entry.near; --place) *place = place[-1];
          *place = entry;
        }
        current = nearest.child;
        continue;
      }
    } else {
      const std::uint32_t count = current.triangles();
      if (counting) counts.triangles += count;
      const TriangleBlock* block = &bvh.blocks[current.first_block()];
      for (std::uint32_t begin = 0; begin < count; begin += TriangleBlock::width, ++block) {
        if (counting) ++counts.blocks;
        for (std::uint32_t hits = maybe_hit(*block, ray); hits != 0; hits &= hits - 1) {
          const std::uint32_t lane = lowest_bit(hits);
          update_nearest(ray, block->triangle(lane), block->indices[lane], best);
        }
      }
    }
    // Equal distance is visited: a lower index may win there.
    do {
      if (top == stack) return;
      --top;
    } while (top->near > best.t);
    current = top->child;
  }
}

template <bool counting>
HWY_INLINE bool any(const Bvh& bvh, const PreparedRay& ray, TraversalCounts& counts) {
  const SlabRay slabs(ray);
  HWY_ALIGN float near[BvhNode::width];
  ChildRef stack[stack_size];
  ChildRef* top = stack;
  *top++ = ChildRef::inner(0);
  while (top != stack) {
    const ChildRef child = *--top;
    if (counting) ++counts.nodes;
    if (!child.is_leaf()) {
      if (counting) ++counts.inner_nodes;
      const BvhNode& node = bvh.nodes[child.node()];
      std::uint32_t hits = slabs.meet_children(node, ray.t_max, near);
      for (; hits != 0; hits &= hits - 1) *top++ = node.children[lowest_bit(hits)];
      continue;
    }
    const std::uint32_t count = child.triangles();
    if (counting) counts.triangles += count;
    const TriangleBlock* block = &bvh.blocks[child.first_block()];
    for (std::uint32_t begin = 0; begin < count; begin += TriangleBlock::width, ++block) {
      if (counting) ++counts.blocks;
      TriangleHit hit;
      for (std::uint32_t hits = maybe_hit(*block, ray); hits != 0; hits &= hits - 1) {
        if (intersect_triangle(ray, block->triangle(lowest_bit(hits)), ray.t_max, hit)) return true;
      }
    }
  }
  return false;
}

template <bool counting>
void closest_batch(const Bvh& bvh, std::span<const PreparedRay> rays, std::span<Hit> hits,
                   TraversalCounts& counts) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    closest<counting>(bvh, rays[i], hits[i], counts);
  }
}

template <bool counting>
void any_batch(const Bvh& bvh, std::span<const PreparedRay> rays, std::span<std::uint8_t> results,
               TraversalCounts& counts) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (results[i] == 0) results[i] = any<counting>(bvh, rays[i], counts) ? 1 : 0;
  }
}

void closest_kernel(const Bvh& bvh, std::span<const PreparedRay> rays, std::span<Hit> hits,
                    TraversalCounts* counts) {
  TraversalCounts none;
  if (counts != nullptr) {
    closest_batch<true>(bvh, rays, hits, *counts);
  } else {
    closest_batch<false>(bvh, rays, hits, none);
  }
}

void any_kernel(const Bvh& bvh, std::span<const PreparedRay> rays, std::span<std::uint8_t> results,
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

void closest_hits(const Bvh& bvh, std::span<const PreparedRay> rays, std::span<Hit> hits,
                  TraversalCounts* counts) {
  if (bvh.nodes.empty()) return;
  HWY_DYNAMIC_DISPATCH(closest_kernel)(bvh, rays, hits, counts);
}

void occluded(const Bvh& bvh, std::span<const PreparedRay> rays, std::span<std::uint8_t> results,
              TraversalCounts* counts) {
  if (bvh.nodes.empty()) return;
  HWY_DYNAMIC_DISPATCH(any_kernel)(bvh, rays, results, counts);
}

}  // namespace pah
#endif
