// Four floats side by side: x, y and z of one ray or triangle, and one that is for nothing. In the
// vector types of GCC and Clang: every machine has four lanes, so that nothing is to be chosen at
// run time, and every operation rounds as that of a float does.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <pah/geometry/vec.hpp>

namespace pah {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

[[nodiscard, gnu::always_inline]] inline Float4 splat(float x) { return Float4{x, x, x, x}; }
[[nodiscard, gnu::always_inline]] inline Float4 float4(const Vec3& v, float w = 0) {
  return Float4{v.x, v.y, v.z, w};
}

// Of any alignment.
[[nodiscard, gnu::always_inline]] inline Float4 load4(const float* four) {
  Float4 loaded;
  std::memcpy(&loaded, four, sizeof(loaded));
  return loaded;
}

[[nodiscard, gnu::always_inline]] inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
[[nodiscard, gnu::always_inline]] inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }

[[nodiscard, gnu::always_inline]] inline Float4 abs(Float4 a) {
  return std::bit_cast<Float4>(std::bit_cast<Int4>(a) & 0x7FFFFFFF);
}
// `size` is not negative.
[[nodiscard, gnu::always_inline]] inline Float4 with_sign_of(Float4 size, Float4 sign) {
  return std::bit_cast<Float4>(std::bit_cast<Int4>(size) |
                               (std::bit_cast<Int4>(sign) & std::int32_t{-0x7FFFFFFF - 1}));
}

// Of x, y and z.
[[nodiscard, gnu::always_inline]] inline float largest_of(Float4 a) {
  return std::max(a[0], std::max(a[1], a[2]));
}

}  // namespace pah
