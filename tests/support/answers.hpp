// The answers of an accelerator, for comparisons to the last bit.
#pragma once

#include <bit>
#include <cstdint>
#include <pah/accel/accelerator.hpp>
#include <vector>

#include "catch.hpp"

namespace pah::test {

inline bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

inline bool same(const Hit& a, const Hit& b) {
  return a.triangle == b.triangle && same_bits(a.t, b.t) && same_bits(a.u, b.u) &&
         same_bits(a.v, b.v);
}

struct Answers {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> occluded;
};

inline Answers ask(const Accelerator& accelerator, const std::vector<Ray>& rays,
                   TraversalCounts* counts = nullptr) {
  Answers answers{std::vector<Hit>(rays.size()), std::vector<std::uint8_t>(rays.size())};
  accelerator.closest_hit(rays, answers.hits, counts);
  accelerator.occluded(rays, answers.occluded, counts);
  return answers;
}

inline void check_same(const Answers& expected, const Answers& found) {
  std::size_t different = 0;
  std::size_t inconsistent = 0;
  for (std::size_t i = 0; i < expected.hits.size(); ++i) {
    different += same(expected.hits[i], found.hits[i]) ? 0 : 1;
    inconsistent += expected.occluded[i] == found.occluded[i] &&
                            found.hits[i].valid() == (found.occluded[i] != 0)
                        ? 0
                        : 1;
  }
  CHECK(different == 0);
  CHECK(inconsistent == 0);
}

}  // namespace pah::test
