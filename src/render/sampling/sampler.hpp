// The sample sequence: Sobol' points, Owen-scrambled by hashing (Burley, "Practical Hash-based
// Owen Scrambling", JCGT 9(4), 2020), with dimensions padded two at a time.
#pragma once

#include <cstdint>
#include <pah/geometry/vec.hpp>

#include "base/mix_bits.hpp"

namespace pah {

namespace owen {

// These are inlined into loops over samplers, which the compiler vectorizes.

template <typename Word>
[[nodiscard, gnu::always_inline]] inline Word reverse_bits(Word x) {
  constexpr Word all = ~Word{0};
  if constexpr (sizeof(Word) == 8) {
    x = __builtin_bswap64(x);
  } else {
    x = __builtin_bswap32(x);
  }
  x = ((x & all / 0x11) << 4U) | ((x >> 4U) & all / 0x11);
  x = ((x & all / 0x05) << 2U) | ((x >> 2U) & all / 0x05);
  return ((x & all / 0x03) << 1U) | ((x >> 1U) & all / 0x03);
}

// A permutation in which bit i depends on bits 0 .. i only: an Owen scramble of the bit-reversed
// number (Laine and Karras 2011), with Vegdahl's constants ("Building a Better LK Hash", 2021).
[[nodiscard, gnu::always_inline]] inline std::uint32_t laine_karras(std::uint32_t x,
                                                                    std::uint32_t seed) {
  x ^= x * 0x3D20ADEAU;
  x += seed;
  x *= (seed >> 16U) | 1U;
  x ^= x * 0x05526C56U;
  x ^= x * 0x53A22864U;
  return x;
}

// The digits of the second Sobol' dimension, least significant bit first. Its generator matrix is
// Pascal's triangle modulo 2, whose entry (k, j) is odd where k's bits are a subset of j's: digit
// k is the parity of all index bits j that contain k, summed one bit of j at a time.
[[nodiscard, gnu::always_inline]] inline std::uint32_t sobol_y_digits(std::uint32_t index) {
  std::uint32_t x = index;
  x ^= (x >> 1U) & 0x55555555U;
  x ^= (x >> 2U) & 0x33333333U;
  x ^= (x >> 4U) & 0x0F0F0F0FU;
  x ^= (x >> 8U) & 0x00FF00FFU;
  return x ^ (x >> 16U);
}

// Only 24 digits fit a float; by way of a signed number, for which all machines have an
// instruction.
[[nodiscard, gnu::always_inline]] inline float fraction(std::uint32_t digits) {
  return static_cast<float>(static_cast<std::int32_t>(digits >> 8U)) * 0x1p-24F;
}

// The point of one dimension of the sequence; its first coordinate is what a dimension of one
// number has.
struct Digits {
  std::uint32_t x, y;  // least significant bit first
};
[[nodiscard, gnu::always_inline]] inline Digits point_digits(std::uint64_t stream,
                                                             std::uint32_t reversed_index,
                                                             std::uint32_t dimension) {
  const std::uint64_t key = mix_bits(stream + dimension);
  const std::uint64_t key_y = mix_bits(key);
  const std::uint32_t index =
      reverse_bits(laine_karras(reversed_index, static_cast<std::uint32_t>(key)));
  return {laine_karras(index, static_cast<std::uint32_t>(key >> 32U)),
          laine_karras(sobol_y_digits(index), static_cast<std::uint32_t>(key_y >> 32U))};
}

}  // namespace owen

// The random numbers of one sample of one pixel: a small value that walks through its dimensions.
// What it returns depends on (x, y, index, seed) and on how many calls came before, nothing else.
//
// Each call opens a fresh dimension. The samples 0 .. 2^k - 1 of a pixel are, in that dimension, a
// (0,k,1)-net or a (0,k,2)-net; between dimensions and between pixels they are independent. Sample
// indices up to 2^32 - 1 are distinct. DrawnNumbers draws for several at once.
class Sampler {
 public:
  Sampler(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint64_t seed)
      : stream_(mix_bits(mix_bits(seed) + ((std::uint64_t{y} << 32U) | x))),
        reversed_index_(owen::reverse_bits(index)) {}

  // In [0, 1), a multiple of 2^-24.
  [[nodiscard]] float next_1d() {
    const owen::Digits digits = owen::point_digits(stream_, reversed_index_, dimension_++);
    return owen::fraction(owen::reverse_bits(digits.x));
  }
  [[nodiscard]] Vec2 next_2d() {
    const owen::Digits digits = owen::point_digits(stream_, reversed_index_, dimension_++);
    const std::uint64_t both = owen::reverse_bits((std::uint64_t{digits.x} << 32U) | digits.y);
    return {owen::fraction(static_cast<std::uint32_t>(both)),
            owen::fraction(static_cast<std::uint32_t>(both >> 32U))};
  }
  // Skips dimensions that were drawn elsewhere or are not needed.
  void skip(std::uint32_t dimensions) { dimension_ += dimensions; }

 private:
  friend class DrawnNumbers;

  std::uint64_t stream_;  // of the pixel
  std::uint32_t reversed_index_;
  std::uint32_t dimension_ = 0;
};

static_assert(sizeof(Sampler) <= 16);

}  // namespace pah
