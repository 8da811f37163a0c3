// The sample sequence: Sobol' points, Owen-scrambled by hashing (Burley, "Practical Hash-based
// Owen Scrambling", JCGT 9(4), 2020), with dimensions padded two at a time.
#pragma once

#include <cstdint>
#include <pah/geometry/vec.hpp>

#include "geometry/mix_bits.hpp"

namespace pah {

// The random numbers of one sample of one pixel: a small value that walks through its dimensions.
// What it returns depends on (x, y, index, seed) and on how many calls came before, nothing else.
//
// Each call opens a fresh dimension. The samples 0 .. 2^k - 1 of a pixel are, in that dimension, a
// (0,k,1)-net or a (0,k,2)-net; between dimensions and between pixels they are independent. Sample
// indices up to 2^32 - 1 are distinct.
class Sampler {
 public:
  Sampler(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint64_t seed)
      : stream_(mix_bits(mix_bits(seed) + ((std::uint64_t{y} << 32U) | x))),
        reversed_index_(reverse_bits(index)) {}

  // In [0, 1), a multiple of 2^-24.
  [[nodiscard]] float next_1d() {
    const std::uint64_t key = mix_bits(stream_ + dimension_++);
    const std::uint32_t digits = laine_karras(shuffled_index(low(key)), high(key));
    return fraction(reverse_bits(digits));
  }
  // The same dimension, left out if nobody wants it.
  [[nodiscard]] float next_1d_if(bool wanted) {
    if (wanted) return next_1d();
    ++dimension_;
    return 0;
  }
  [[nodiscard]] Vec2 next_2d() {
    const std::uint64_t key = mix_bits(stream_ + dimension_++);
    const std::uint64_t key_y = mix_bits(key);
    const std::uint32_t index = shuffled_index(low(key));
    const std::uint32_t x = laine_karras(index, high(key));
    const std::uint32_t y = laine_karras(sobol_y_digits(index), high(key_y));
    const std::uint64_t both = reverse_bits((std::uint64_t{x} << 32U) | y);
    return {fraction(low(both)), fraction(high(both))};
  }

 private:
  static std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32U); }
  static std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }

  template <typename Word>
  static Word reverse_bits(Word x) {
    constexpr Word all = ~Word{0};
    x = byte_swapped(x);
    x = ((x & all / 0x11) << 4U) | ((x >> 4U) & all / 0x11);
    x = ((x & all / 0x05) << 2U) | ((x >> 2U) & all / 0x05);
    return ((x & all / 0x03) << 1U) | ((x >> 1U) & all / 0x03);
  }
  static std::uint32_t byte_swapped(std::uint32_t x) { return __builtin_bswap32(x); }
  static std::uint64_t byte_swapped(std::uint64_t x) { return __builtin_bswap64(x); }

  // A permutation in which bit i depends on bits 0 .. i only: an Owen scramble of the bit-reversed
  // number (Laine and Karras 2011), with Vegdahl's constants ("Building a Better LK Hash", 2021).
  static std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
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
  static std::uint32_t sobol_y_digits(std::uint32_t index) {
    std::uint32_t x = index;
    x ^= (x >> 1U) & 0x55555555U;
    x ^= (x >> 2U) & 0x33333333U;
    x ^= (x >> 4U) & 0x0F0F0F0FU;
    x ^= (x >> 8U) & 0x00FF00FFU;
    return x ^ (x >> 16U);
  }

  [[nodiscard]] std::uint32_t shuffled_index(std::uint32_t seed) const {
    return reverse_bits(laine_karras(reversed_index_, seed));
  }
  // Only 24 digits fit a float.
  static float fraction(std::uint32_t digits) {
    return static_cast<float>(digits >> 8U) * 0x1p-24F;
  }

  std::uint64_t stream_;  // of the pixel
  std::uint32_t reversed_index_;
  std::uint32_t dimension_ = 0;
};

static_assert(sizeof(Sampler) <= 16);

}  // namespace pah
