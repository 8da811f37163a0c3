#include "render/sampling/drawn_numbers.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sampling/drawn_numbers.cpp"
#include <hwy/foreach_target.h>
// highway.h must follow foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pah {
namespace HWY_NAMESPACE {
namespace {

// Scalar code that the compiler vectorizes, once for each instruction set. It fills one row of
// `lanes` numbers for each dimension.
void draw_kernel(const std::uint64_t* __restrict stream,
                 const std::uint32_t* __restrict reversed_index,
                 const std::uint32_t* __restrict first, std::size_t dimensions, float* __restrict x,
                 float* __restrict y) {
  constexpr std::size_t lanes = DrawnNumbers::lanes;
  for (std::uint32_t further = 0; further < dimensions; ++further, x += lanes, y += lanes) {
    for (std::size_t i = 0; i < lanes; ++i) {
      const owen::Digits digits =
          owen::point_digits(stream[i], reversed_index[i], first[i] + further);
      x[i] = owen::fraction(owen::reverse_bits(digits.x));
      y[i] = owen::fraction(owen::reverse_bits(digits.y));
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace pah
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pah {

namespace {

HWY_EXPORT(draw_kernel);

}  // namespace

void DrawnNumbers::draw(std::size_t dimensions) {
  HWY_DYNAMIC_DISPATCH(draw_kernel)
  (stream_.data(), reversed_index_.data(), dimension_.data(), dimensions, x_.data()->data(),
   y_.data()->data());
}

}  // namespace pah
#endif
