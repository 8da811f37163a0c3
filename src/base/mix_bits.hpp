#pragma once

#include <cstdint>

namespace pah {

// Stafford's variant 13 of the 64-bit finalizer of MurmurHash3: every bit of the input flips every
// bit of the output with probability 1/2.
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

}  // namespace pah
