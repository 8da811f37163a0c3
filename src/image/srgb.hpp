// Conversion between sRGB (IEC 61966-2-1) and linear light. Negative values continue the straight
// line at 0.
//
// The result depends on the argument's precision to the last bit, so float and double both exist.
#pragma once

#include <cmath>
#include <concepts>

namespace pah {

template <std::floating_point Real>
[[nodiscard]] Real linear_from_srgb(Real encoded) {
  return encoded <= Real(0.04045) ? encoded / Real(12.92)
                                  : std::pow((encoded + Real(0.055)) / Real(1.055), Real(2.4));
}

template <std::floating_point Real>
[[nodiscard]] Real srgb_from_linear(Real linear) {
  return linear <= Real(0.0031308) ? Real(12.92) * linear
                                   : Real(1.055) * std::pow(linear, 1 / Real(2.4)) - Real(0.055);
}

}  // namespace pah
