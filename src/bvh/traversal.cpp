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

// A ray as nodes are tested with it.
struct NodeRay {
  using D = hn::CappedTag<float, BvhNode::width>;
  hn::Vec<D> inverse[3];
  hn::Vec<D> near_offset[3];
  hn::Vec<D> far_offset[3];
  std::size_t near_planes[3];  // where in a node, in floats
  std::size_t far_planes[3];

  HWY_INLINE explicit NodeRay(const PreparedRay& ray) {
    const D d;
    for (int axis = 0; axis < 3; ++axis) {
      inverse[axis] = hn::Set(d, ray.node_inverse[axis]);
      near_offset[axis] = hn::Set(d, ray.near_offset[axis]);
      far_offset[axis] = hn::Set(d, ray.far_offset[axis]);
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

// Triangles as a ray sees them.
struct ShearedBlock {
  HWY_ALIGN float vertices[3][3][TriangleBlock::width];
  HWY_ALIGN float edges[3][TriangleBlock::width];

  [[nodiscard]] HWY_INLINE detail::ShearedVertex vertex(std::size_t k, std::size_t lane) const {
    return {vertices[k][0][lane], vertices[k][1][lane], vertices[k][2][lane]};
  }
  // The rest of the rule for one of them.
  HWY_INLINE bool accept(const PreparedRay& ray, const TriangleBlock& block, std::size_t lane,
                         float t_limit, TriangleHit& hit) const {
    const auto corner = [&](std::size_t k) {
      const auto& v = block.vertices[k];
      return Float4{v[0][lane], v[1][lane], v[2][lane], 0};
    };
    return detail::accept(
        ray, detail::own_interval(ray, corner(0), corner(1), corner(2)), vertex(0, lane),
        vertex(1, lane), vertex(2, lane),
        detail::EdgeFunctions<float>(edges[0][lane], edges[1][lane], edges[2][lane]), t_limit, hit);
  }
};

// A ray as triangles are tested with it.
struct TriangleRay {
  using D = hn::CappedTag<float, TriangleBlock::width>;
  hn::Vec<D> origin[3];
  hn::Vec<D> shear[2];
  std::size_t axes[3];  // where in a vertex, in floats

  HWY_INLINE explicit TriangleRay(const PreparedRay& ray) {
    const D d;
    for (int i = 0; i < 3; ++i) {
      origin[i] = hn::Set(d, ray.origin[i]);
      axes[i] = ray.axes[static_cast<std::size_t>(i)] * TriangleBlock::width;
    }
    shear[0] = hn::Set(d, ray.shear_x);
    shear[1] = hn::Set(d, ray.shear_y);
  }

  // Which triangles pass the signs of the edge functions: the formulas of ray_triangle.hpp, side by
  // side. Survivors are few, and the rest of the shared rule decides them.
  HWY_INLINE std::uint32_t maybe_hit(const TriangleBlock& block, ShearedBlock& sheared) const {
    const D d;
    const auto zero = hn::Zero(d);
    std::uint32_t hits = 0;
    for (std::size_t lane = 0; lane < TriangleBlock::width; lane += hn::Lanes(d)) {
      hn::Vec<D> x[3];
      hn::Vec<D> y[3];
      hn::Vec<D> z[3];
      for (int k = 0; k < 3; ++k) {
        const float* vertex = block.vertices[k][0] + lane;
        z[k] = hn::Sub(hn::Load(d, vertex + axes[2]), origin[2]);
        x[k] = hn::Sub(hn::Sub(hn::Load(d, vertex + axes[0]), origin[0]), hn::Mul(shear[0], z[k]));
        y[k] = hn::Sub(hn::Sub(hn::Load(d, vertex + axes[1]), origin[1]), hn::Mul(shear[1], z[k]));
      }
      const auto a = hn::Sub(hn::Mul(x[2], y[1]), hn::Mul(y[2], x[1]));
      const auto b = hn::Sub(hn::Mul(x[0], y[2]), hn::Mul(y[0], x[2]));
      const auto c = hn::Sub(hn::Mul(x[1], y[0]), hn::Mul(y[1], x[0]));
      const auto least = hn::Min(hn::Min(a, b), c);
      const auto most = hn::Max(hn::Max(a, b), c);
      const std::uint32_t some = bits(d, hn::Not(hn::And(hn::Lt(least, zero), hn::Gt(most, zero))));
      if (some == 0) continue;
      hits |= some << lane;
      for (int k = 0; k < 3; ++k) {
        hn::Store(x[k], d, sheared.vertices[k][0] + lane);
        hn::Store(y[k], d, sheared.vertices[k][1] + lane);
        hn::Store(z[k], d, sheared.vertices[k][2] + lane);
      }
      hn::Store(a, d, sheared.edges[0] + lane);
      hn::Store(b, d, sheared.edges[1] + lane);
      hn::Store(c, d, sheared.edges[2] + lane);
    }
    return hits;
  }
};

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
  const NodeRay nodes(ray);
  const TriangleRay triangles(ray);
  ShearedBlock sheared;
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
        for (std::uint32_t hits = triangles.maybe_hit(*block, sheared); hits != 0;
             hits &= hits - 1) {
          const std::uint32_t lane = lowest_bit(hits);
          TriangleHit hit;
          if (sheared.accept(ray, *block, lane, best.t, hit))
            keep_nearer(hit, block->indices[lane], best);
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
  const NodeRay nodes(ray);
  const TriangleRay triangles(ray);
  ShearedBlock sheared;
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
      std::uint32_t hits = nodes.meet_children(node, ray.t_max, near);
      for (; hits != 0; hits &= hits - 1) *top++ = node.children[lowest_bit(hits)];
      continue;
    }
    const std::uint32_t count = child.triangles();
    if (counting) counts.triangles += count;
    const TriangleBlock* block = &bvh.blocks[child.first_block()];
    for (std::uint32_t begin = 0; begin < count; begin += TriangleBlock::width, ++block) {
      if (counting) ++counts.blocks;
      TriangleHit hit;
      for (std::uint32_t hits = triangles.maybe_hit(*block, sheared); hits != 0; hits &= hits - 1) {
        if (sheared.accept(ray, *block, lowest_bit(hits), ray.t_max, hit)) return true;
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
