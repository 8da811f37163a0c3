#include "render/sampler.hpp"

#include "geometry/mix_bits.hpp"

namespace pah {
namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00FF00FFU) << 8) | ((x >> 8) & 0x00FF00FFU);
  x = ((x & 0x0F0F0F0FU) << 4) | ((x >> 4) & 0x0F0F0F0FU);
  x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
  return ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
}

// A permutation in which bit i depends on bits 0 .. i only: an Owen scramble of the bit-reversed
// number (Laine and Karras 2011), with Vegdahl's constants ("Building a Better LK Hash", 2021).
std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3D20ADEAU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526C56U;
  x ^= x * 0x53A22864U;
  return x;
}

// The digits of the second Sobol' dimension, least significant bit first. Its generator matrix is
// Pascal's triangle modulo 2, whose entry (k, j) is odd where k's bits are a subset of j's: digit k
// is the parity of all index bits j that contain k, summed one bit of j at a time.
std::uint32_t sobol_y_digits(std::uint32_t index) {
  std::uint32_t x = index;
  x ^= (x >> 1) & 0x55555555U;
  x ^= (x >> 2) & 0x33333333U;
  x ^= (x >> 4) & 0x0F0F0F0FU;
  x ^= (x >> 8) & 0x00FF00FFU;
  return x ^ (x >> 16);
}

// The digits (least significant first) as a scrambled fraction. Only 24 of them fit a float.
float scrambled_fraction(std::uint32_t digits, std::uint32_t seed) {
  return static_cast<float>(reverse_bits(laine_karras(digits, seed)) >> 8) * 0x1p-24F;
}

std::uint32_t shuffled_index(std::uint32_t index, std::uint32_t seed) {
  return reverse_bits(laine_karras(reverse_bits(index), seed));
}

std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }
std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }

}  // namespace

Sampler::Sampler(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint64_t seed)
    : stream_(mix_bits(mix_bits(seed) + ((static_cast<std::uint64_t>(y) << 32) | x))),
      index_(index) {}

float Sampler::next_1d() {
  const std::uint64_t key = mix_bits(stream_ + dimension_++);
  return scrambled_fraction(shuffled_index(index_, low(key)), high(key));
}

Vec2 Sampler::next_2d() {
  const std::uint64_t key = mix_bits(stream_ + dimension_++);
  const std::uint64_t key_y = mix_bits(key);
  const std::uint32_t index = shuffled_index(index_, low(key));
  return {scrambled_fraction(index, high(key)),
          scrambled_fraction(sobol_y_digits(index), high(key_y))};
}

}  // namespace pah
