// Bounds of floating-point rounding (Higham, Accuracy and Stability of Numerical Algorithms, 3.1).
#pragma once

namespace pah {

inline constexpr float unit_roundoff = 0x1p-24F;
inline constexpr double double_unit_roundoff = 0x1p-53;

// n roundings of float in a row change a value by a factor within 1 +- rounding_bound(n).
[[nodiscard]] constexpr float rounding_bound(int n) {
  const float x = static_cast<float>(n) * unit_roundoff;
  return x / (1.0F - x);
}

}  // namespace pah
