// Means over the study's rows.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "report/study/study.hpp"

namespace pah {

// Returns the mean of `value(row)` over the rows for which `take(row)` holds; NaN without rows.
template <typename Row, typename Take, typename Value>
[[nodiscard]] double mean_of(const std::vector<Row>& rows, const Take& take, const Value& value) {
  double sum = 0;
  std::size_t count = 0;
  for (const Row& row : rows) {
    if (!take(row)) continue;
    sum += value(row);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : std::nan("");
}

// |predicted - measured| / measured.
[[nodiscard]] inline double relative_error(double predicted, const PredictionRow& row) {
  return std::abs(predicted - row.measured) / row.measured;
}

// A tree of the comparison.
struct StudyVariant {
  Heuristic heuristic;
  SplitAxis split;

  [[nodiscard]] bool built(const CostRow& row) const {
    return row.tree.heuristic == heuristic && row.tree.split == split;
  }
  [[nodiscard]] std::string name() const {
    return std::string(label_of(heuristic)) + " + " + label_of(split);
  }
};

inline constexpr StudyVariant sah_longest{Heuristic::surface_area, SplitAxis::longest};
inline constexpr StudyVariant sah_best{Heuristic::surface_area, SplitAxis::best};
inline constexpr StudyVariant sah_facing{Heuristic::surface_area, SplitAxis::facing};
inline constexpr StudyVariant pah_longest{Heuristic::projected_area, SplitAxis::longest};
inline constexpr StudyVariant pah_best{Heuristic::projected_area, SplitAxis::best};
inline constexpr StudyVariant pah_facing{Heuristic::projected_area, SplitAxis::facing};
inline constexpr StudyVariant mean_longest{Heuristic::mean_direction, SplitAxis::longest};
inline constexpr StudyVariant mean_best{Heuristic::mean_direction, SplitAxis::best};
inline constexpr StudyVariant mean_facing{Heuristic::mean_direction, SplitAxis::facing};
inline constexpr StudyVariant study_variants[] = {sah_longest,  sah_best,  sah_facing,
                                                  pah_longest,  pah_best,  pah_facing,
                                                  mean_longest, mean_best, mean_facing};

// Returns the section of the report on the thesis's claims.
[[nodiscard]] std::string study_findings(const StudyResults& results);

// Returns the section on rays per second; empty if none were measured.
[[nodiscard]] std::string rates_markdown(const StudyResults& results, bool with_plots);

// Returns the rows with `value` divided by that of `base` in the same area.
[[nodiscard]] std::vector<CostRow> relative_costs(const std::vector<CostRow>& rows,
                                                  const StudyVariant& base, double CostRow::*value);

// Returns the meshes' names, in the order of the rows.
[[nodiscard]] inline std::vector<std::string> meshes_of(const StudyResults& results) {
  std::vector<std::string> names;
  for (const CostRow& row : results.costs)
    if (names.empty() || names.back() != row.tree.mesh) names.push_back(row.tree.mesh);
  return names;
}

}  // namespace pah
