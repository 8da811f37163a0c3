// Medians over the repetitions of a measurement.
#pragma once

#include <array>

#include "report/study/study.hpp"

namespace pah {

// In the order of columns.
inline constexpr std::array<const char*, 5> rate_accelerators{"bvh", "local", "light", "embree",
                                                              "embree16"};

// The rays of one kind in one scene, on a number of threads.
struct RateCase {
  std::string scene, ray_kind;
  unsigned threads = 1;

  [[nodiscard]] bool operator==(const RateCase&) const = default;
};
[[nodiscard]] inline RateCase case_of(const RateRow& row) {
  return {row.scene, row.ray_kind, row.threads};
}
// Returns the cases in the order of the rows.
[[nodiscard]] std::vector<RateCase> cases_of(const std::vector<RateRow>& rows);

// Rays per second; NaN without rows.
struct RateSpread {
  double median = 0, least = 0, most = 0;
};
[[nodiscard]] RateSpread spread_of(const std::vector<RateRow>& rows, const RateCase& of,
                                   const std::string& accelerator);

// Returns the median, over repetitions, of the speed of `accelerator` relative to `base` in the
// same repetition; NaN if one of the two is missing.
[[nodiscard]] double ratio_of(const std::vector<RateRow>& rows, const RateCase& of,
                              const std::string& accelerator, const std::string& base);

}  // namespace pah
