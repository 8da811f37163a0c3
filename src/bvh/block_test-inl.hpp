// Tests a ray against blocks of triangles. Kernels include it once for each instruction set.
#if defined(PAH_BVH_BLOCK_TEST_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PAH_BVH_BLOCK_TEST_INL
#undef PAH_BVH_BLOCK_TEST_INL
#else
#define PAH_BVH_BLOCK_TEST_INL
#endif

#include <hwy/highway.h>

#include "bvh/bvh.hpp"
#include "geometry/ray_triangle.hpp"

HWY_BEFORE_NAMESPACE();
namespace pah {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Bit i of the result is lane i of the mask.
template <class D, class M>
HWY_INLINE std::uint32_t bits(D d, M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0];
}

// One of four rays that were prepared together.
struct OneOfFour {
  const Prepared<Float4>& four;
  std::size_t k;

  [[nodiscard]] float t_max() const { return four.t_max[k]; }
};

HWY_INLINE std::uint32_t lowest_bit(std::uint32_t mask) {
  return static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(mask));
}

// Applies the scalar rule where the block's test cannot decide. It is rare, and not inlined: it
// would take registers from the loops.
HWY_NOINLINE bool decide(const OneOfFour& ray, const TriangleBlock& block, std::size_t lane,
                         float limit, TriangleHit& hit) {
  return intersect_triangle(extracted(ray.four, ray.k), block.triangle(lane), limit, hit);
}

// The results of a block's test.
struct BlockHits {
  HWY_ALIGN float t[TriangleBlock::width];
  HWY_ALIGN float u[TriangleBlock::width];
  HWY_ALIGN float v[TriangleBlock::width];
  std::uint32_t known = 0;  // bit i: triangle i is hit at t[i]; else decide() must be called

  HWY_INLINE bool accept(const OneOfFour& ray, const TriangleBlock& block, std::size_t lane,
                         float limit, TriangleHit& hit) const {
    if ((known >> lane & 1U) == 0) return decide(ray, block, lane, limit, hit);
    hit = {t[lane], u[lane], v[lane]};
    return hit.t <= limit;
  }
};

// The formulas of ray_triangle.hpp, one triangle per lane.
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

// Bit i is set if triangle i is hit within the limit, or may be. Every operation follows the scalar
// rule, so that results agree to the last bit.
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
    // Rejects triangles behind the origin early: most rays start next to one.
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

// Whether the ray hits any triangle of the block.
HWY_INLINE bool hits_any(const OneOfFour& ray, const TriangleBlock& block, BlockHits& found) {
  TriangleHit hit;
  for (std::uint32_t hits = maybe_hit(ray, block, ray.t_max(), found); hits != 0;
       hits &= hits - 1) {
    if (found.accept(ray, block, lowest_bit(hits), ray.t_max(), hit)) return true;
  }
  return false;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace pah
HWY_AFTER_NAMESPACE();

#endif
