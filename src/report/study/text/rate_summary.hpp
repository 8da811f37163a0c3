// Medians over the repetitions of a measurement.
#pragma once

#include <array>

#include "report/study/study.hpp"

namespace pah {

// In the order of columns.
inline constexpr std::array<const char*, 5> rate_accelerators{"bvh", "local", "light", "embree",
                                                              "embree16"};

// The rays of one kind in one scene, asked by so many threads.
struct RateCase {
  std::string scene, ray_kind;
  unsigned threads = 1;

  [[nodiscard]] bool operator==(const RateCase&) const = default;
};
[[nodiscard]] inline RateCase case_of(const RateRow& row) {
  return {row.scene, row.ray_kind, row.threads};
}
// In the order of the rows.
[[nodiscard]] std::vector<RateCase> cases_of(const std::vector<RateRow>& rows);

// Rays a second. NaN if there are none.
struct RateSpread {
  double median = 0, least = 0, most = 0;
};
[[nodiscard]] RateSpread spread_of(const std::vector<RateRow>& rows, const RateCase& of,
                                   const std::string& accelerator);

// The median over repetitions of how many times as fast `accelerator` was as `base` in the same
// repetition; NaN if one of both is not there.
[[nodiscard]] double ratio_of(const std::vector<RateRow>& rows, const RateCase& of,
                              const std::string& accelerator, const std::string& base);

}  // namespace pah
