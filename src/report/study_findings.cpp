// What the thesis and its follow-up paper report, beside what was found here.
#include <fmt/format.h>

#include "report/study_means.hpp"

namespace pah {
namespace {

struct Finding {
  std::string claim, found;
  bool holds = false;
};

double error_of(const StudyResults& results, double PredictionRow::*prediction, bool planes,
                bool points) {
  return mean_of(
      results.predictions,
      [&](const PredictionRow& row) { return is_point(row.tree.group) ? points : planes; },
      [&](const PredictionRow& row) { return relative_error(row.*prediction, row); });
}

template <typename Take>
double cost_of(const StudyResults& results, const StudyVariant& variant, const Take& take,
               double CostRow::*value = &CostRow::over_longest) {
  return mean_of(
      results.costs, [&](const CostRow& row) { return variant.built(row) && take(row.tree.group); },
      [&](const CostRow& row) { return row.*value; });
}

bool along_axis(StudyGroup group) { return group == StudyGroup::plane_axis; }
bool not_along_axis(StudyGroup group) { return group != StudyGroup::plane_axis; }
bool any_group(StudyGroup) { return true; }

// In how many areas PAH builds a cheaper tree than SAH does, the axes being chosen alike.
Finding pah_alone(const StudyResults& results) {
  std::size_t better = 0;
  std::size_t compared = 0;
  // The rows of an area are in the order of study_variants.
  for (std::size_t i = 0; i + 5 < results.costs.size(); i += 6) {
    for (const std::size_t split : {std::size_t{0}, std::size_t{1}}) {
      ++compared;
      better += results.costs[i + 3 + split].cost < results.costs[i + split].cost ? 1 : 0;
    }
  }
  return {"PAH without SPFH never builds a better tree than SAH",
          fmt::format("cheaper in {} of {} comparisons; mean PAH/SAH {:.3f} (best axis), {:.3f} "
                      "(longest)",
                      better, compared, cost_of(results, pah_best, any_group, &CostRow::over_best),
                      cost_of(results, pah_longest, any_group)),
          better == 0};
}

Finding builds(const StudyResults& results) {
  const auto seconds = [&](const StudyVariant& variant) {
    return mean_of(
        results.costs, [&](const CostRow& row) { return variant.built(row); },
        [](const CostRow& row) { return row.build_seconds; });
  };
  const double ratio = seconds(pah_best) / seconds(sah_best);
  const auto by_kind = [&](bool point) {
    const auto sum = [&](const StudyVariant& variant) {
      return mean_of(
          results.costs,
          [&](const CostRow& row) {
            return variant.built(row) && is_point(row.tree.group) == point;
          },
          [](const CostRow& row) { return row.build_seconds; });
    };
    return sum(pah_best) / sum(sah_best);
  };
  return {"PAH takes about 10 times as long to build as SAH",
          fmt::format("{:.1f} times ({:.1f} plane, {:.1f} point)", ratio, by_kind(false),
                      by_kind(true)),
          ratio >= 5 && ratio <= 20};
}

std::vector<Finding> findings(const StudyResults& results) {
  const double plane = error_of(results, &PredictionRow::pah, true, false);
  const double point = error_of(results, &PredictionRow::pah, false, true);
  const double pah = error_of(results, &PredictionRow::pah, true, true);
  const double sah = error_of(results, &PredictionRow::sah, true, true);
  const double plane_unclipped = error_of(results, &PredictionRow::pah_unclipped, true, false);
  const double point_unclipped = error_of(results, &PredictionRow::pah_unclipped, false, true);
  const double facing_axis = cost_of(results, pah_facing, along_axis);
  const double facing_else = cost_of(results, pah_facing, not_along_axis);
  const double facing_axis_best = cost_of(results, pah_facing, along_axis, &CostRow::over_best);
  const double sah_axis = cost_of(results, sah_facing, along_axis);
  const double sah_else = cost_of(results, sah_facing, not_along_axis);
  return {
      {"PAH predicts the cost with a mean error of 7 % (2 % plane, 12 % point)",
       fmt::format("{:.2f} % ({:.2f} % plane, {:.2f} % point)", 100 * pah, 100 * plane,
                   100 * point),
       pah <= 0.07},
      {"SAH's error is 36 %: far above PAH's", fmt::format("{:.0f} %", 100 * sah), sah > 2 * pah},
      {"Clipping matters: without it 12 % plane, 23 % point",
       fmt::format("{:.0f} % plane, {:.0f} % point", 100 * plane_unclipped, 100 * point_unclipped),
       plane_unclipped > 1.5 * plane && point_unclipped > 1.5 * point},
      {"PAH + SPFH is cheaper than SAH + longest axis only where rays run along an axis",
       fmt::format("{:.3f} along an axis, {:.3f} elsewhere ({:.3f} of SAH + best axis along one)",
                   facing_axis, facing_else, facing_axis_best),
       facing_axis < 1 && facing_else >= 1},
      pah_alone(results),
      {"SAH + SPFH is better than SAH + longest axis along an axis, and no worse elsewhere",
       fmt::format("{:.3f} along an axis, {:.3f} elsewhere", sah_axis, sah_else),
       sah_axis < 1 && sah_else <= 1},
      builds(results)};
}

}  // namespace

std::string study_findings(const StudyResults& results) {
  std::string text =
      "## Findings\n\n"
      "| thesis and follow-up paper | here | holds |\n"
      "| --- | --- | --- |\n";
  for (const Finding& finding : findings(results))
    text += fmt::format("| {} | {} | {} |\n", finding.claim, finding.found,
                        finding.holds ? "yes" : "no");
  return text + "\n";
}

}  // namespace pah
