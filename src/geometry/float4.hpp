// Vectors of four floats: x, y, z and an unused lane, or one value for each of four rays. They use
// the vector types of GCC and Clang. Every target has four lanes, so nothing is dispatched at run
// time, and every operation rounds as the scalar one does.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <pah/geometry/vec.hpp>
#include <type_traits>

namespace pah {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

[[nodiscard, gnu::always_inline]] inline Float4 splat(float x) { return Float4{x, x, x, x}; }
[[nodiscard, gnu::always_inline]] inline Float4 float4(const Vec3& v, float w = 0) {
  return Float4{v.x, v.y, v.z, w};
}

// Loads four floats of any alignment.
[[nodiscard, gnu::always_inline]] inline Float4 load4(const float* four) {
  Float4 loaded;
  std::memcpy(&loaded, four, sizeof(loaded));
  return loaded;
}

// The integer type of the same size: std::int32_t for float, Int4 for Float4.
template <typename Real>
using IntOf = std::conditional_t<std::is_same_v<Real, Float4>, Int4, std::int32_t>;

// These work on float and on Float4.
template <typename Real>
[[nodiscard, gnu::always_inline]] inline Real min(const Real& a, const Real& b) {
  return a < b ? a : b;
}
template <typename Real>
[[nodiscard, gnu::always_inline]] inline Real max(const Real& a, const Real& b) {
  return a > b ? a : b;
}
template <typename Real>
[[nodiscard, gnu::always_inline]] inline Real abs(const Real& a) {
  return std::bit_cast<Real>(std::bit_cast<IntOf<Real>>(a) & 0x7FFFFFFF);
}
// `size` must not be negative.
template <typename Real>
[[nodiscard, gnu::always_inline]] inline Real with_sign_of(const Real& size, const Real& sign) {
  return std::bit_cast<Real>(std::bit_cast<IntOf<Real>>(size) |
                             (std::bit_cast<IntOf<Real>>(sign) & std::int32_t{-0x7FFFFFFF - 1}));
}

struct Transposed {
  Float4 x, y, z, w;
};
[[nodiscard, gnu::always_inline]] inline Transposed transposed(Float4 a, Float4 b, Float4 c,
                                                               Float4 d) {
  const Float4 xy_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Float4 zw_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Float4 xy_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Float4 zw_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(xy_ab, xy_cd, 0, 1, 4, 5),
          __builtin_shufflevector(xy_ab, xy_cd, 2, 3, 6, 7),
          __builtin_shufflevector(zw_ab, zw_cd, 0, 1, 4, 5),
          __builtin_shufflevector(zw_ab, zw_cd, 2, 3, 6, 7)};
}

}  // namespace pah
