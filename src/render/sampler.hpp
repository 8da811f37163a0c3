// The sample sequence: Sobol' points, Owen-scrambled by hashing (Burley, "Practical Hash-based
// Owen Scrambling", JCGT 9(4), 2020), with dimensions padded two at a time.
#pragma once

#include <cstdint>
#include <pah/geometry/vec.hpp>

namespace pah {

// The random numbers of one sample of one pixel: a small value that walks through its dimensions.
// What it returns depends on (x, y, index, seed) and on how many calls came before, nothing else.
//
// Each call opens a fresh dimension. The samples 0 .. 2^k - 1 of a pixel are, in that dimension, a
// (0,k,1)-net or a (0,k,2)-net; between dimensions and between pixels they are independent. Sample
// indices up to 2^32 - 1 are distinct.
class Sampler {
 public:
  Sampler(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint64_t seed);

  // In [0, 1), a multiple of 2^-24.
  [[nodiscard]] float next_1d();
  [[nodiscard]] Vec2 next_2d();

 private:
  std::uint64_t stream_;  // of the pixel
  std::uint32_t index_;
  std::uint32_t dimension_ = 0;
};

static_assert(sizeof(Sampler) <= 16);

}  // namespace pah
