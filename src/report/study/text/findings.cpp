// The claims of the thesis and its follow-up paper, beside the findings here.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <pah/bvh/analyze.hpp>

#include "report/study/text/means.hpp"

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

// Returns the mean cost of a variant relative to another's.
template <typename Take>
double over(const StudyResults& results, const StudyVariant& variant, const StudyVariant& base,
            const Take& take, double CostRow::*value = &CostRow::closest) {
  return mean_of(
      relative_costs(results.costs, base, value),
      [&](const CostRow& row) { return variant.built(row) && take(row.tree.group); },
      [&](const CostRow& row) { return row.*value; });
}

bool any_group(StudyGroup) { return true; }

// A variant's costs relative to SAH with the longest axis, by group of areas.
class GroupCosts {
 public:
  GroupCosts(const StudyResults& results, const StudyVariant& variant) {
    for (std::size_t g = 0; g < study_groups; ++g) {
      const auto take = [g](StudyGroup group) { return group == static_cast<StudyGroup>(g); };
      closest_[g] = over(results, variant, sah_longest, take);
      all_[g] = over(results, variant, sah_longest, take, &CostRow::all);
    }
  }
  [[nodiscard]] bool cheaper_along_axis() const { return closest_.front() < 1; }
  // fmin and fmax ignore groups without areas, whose costs are NaN.
  [[nodiscard]] double lowest_elsewhere() const {
    double lowest = std::nan("");
    for (std::size_t g = 1; g < study_groups; ++g) lowest = std::fmin(lowest, closest_[g]);
    return lowest;
  }
  [[nodiscard]] double highest_elsewhere() const {
    double highest = std::nan("");
    for (std::size_t g = 1; g < study_groups; ++g) highest = std::fmax(highest, closest_[g]);
    return highest;
  }
  [[nodiscard]] std::string text() const {
    std::vector<std::string> groups;
    for (std::size_t g = 0; g < study_groups; ++g)
      if (!std::isnan(closest_[g]))
        groups.push_back(fmt::format("{}: {:.2f}, all nodes {:.2f}",
                                     name_of(static_cast<StudyGroup>(g)), closest_[g], all_[g]));
    return fmt::format("{}", fmt::join(groups, "; "));
  }

 private:
  std::array<double, study_groups> closest_{}, all_{};
};

// Counts the areas in which PAH builds a cheaper tree than SAH with the same choice of axes.
Finding pah_alone(const StudyResults& results) {
  std::size_t better = 0;
  std::size_t compared = 0;
  for (const auto& [pah, sah] :
       {std::pair{pah_longest, sah_longest}, std::pair{pah_best, sah_best}})
    for (const CostRow& row : relative_costs(results.costs, sah, &CostRow::closest)) {
      if (!pah.built(row)) continue;
      ++compared;
      better += row.closest < 1 ? 1 : 0;
    }
  return {"PAH without SPFH never builds a better tree than SAH",
          fmt::format("cheaper in {} of {} comparisons; mean PAH/SAH {:.3f} (best axis), {:.3f} "
                      "(longest); all nodes {:.3f}, {:.3f}",
                      better, compared, over(results, pah_best, sah_best, any_group),
                      over(results, pah_longest, sah_longest, any_group),
                      over(results, pah_best, sah_best, any_group, &CostRow::all),
                      over(results, pah_longest, sah_longest, any_group, &CostRow::all)),
          better == 0};
}

Finding build_finding(const StudyResults& results) {
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

// For splits along the rays all positions cost PAH the same; only the longest-axis rule must make
// them.
Finding unbalance(const StudyResults& results) {
  const auto lopsided = [&](const StudyVariant& variant) {
    return 100 * mean_of(
                     results.costs,
                     [&](const CostRow& row) {
                       return variant.built(row) && row.tree.group == StudyGroup::plane_axis;
                     },
                     [](const CostRow& row) { return row.lopsided; });
  };
  const auto bounded = [&](double least_share) {
    return mean_of(
        results.sweeps,
        [&](const SweepRow& row) {
          return row.tree.heuristic == Heuristic::projected_area &&
                 row.parameter == "least_share" && row.value == least_share;
        },
        [](const SweepRow& row) { return row.over_default; });
  };
  const double longest = lopsided(pah_longest), sah = lopsided(sah_longest);
  const double best = lopsided(pah_best), kept = bounded(1.0 / 16);
  return {
      "PAH's greedy minimum is one tiny and one huge child where projections overlap",
      fmt::format("along an axis {:.1f} % of splits leave a child less than {:g} % (SAH {:.1f} %)"
                  " with the longest axis, {:.1f} % with the best; leaving each child at least "
                  "{:g} % changes the cost by {:+.1f} %",
                  longest, 100 * TreeBalance::lopsided_below, sah, best,
                  100 * TreeBalance::lopsided_below, 100 * (kept - 1)),
      longest > sah};
}

std::vector<Finding> findings(const StudyResults& results) {
  const double plane = error_of(results, &PredictionRow::pah, true, false);
  const double point = error_of(results, &PredictionRow::pah, false, true);
  const double pah = error_of(results, &PredictionRow::pah, true, true);
  const double sah = error_of(results, &PredictionRow::sah, true, true);
  const double plane_unclipped = error_of(results, &PredictionRow::pah_unclipped, true, false);
  const double point_unclipped = error_of(results, &PredictionRow::pah_unclipped, false, true);
  const GroupCosts pah_spfh(results, pah_facing);
  const GroupCosts sah_spfh(results, sah_facing);
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
       pah_spfh.text(), pah_spfh.cheaper_along_axis() && pah_spfh.lowest_elsewhere() >= 1},
      pah_alone(results),
      unbalance(results),
      {"SAH + SPFH is better than SAH + longest axis along an axis, and no worse elsewhere",
       sah_spfh.text(), sah_spfh.cheaper_along_axis() && sah_spfh.highest_elsewhere() <= 1},
      build_finding(results)};
}

}  // namespace

std::string study_findings(const StudyResults& results) {
  std::string text =
      "## Findings\n\n"
      "The first cost is that of searching for nearest hits, by which the claims are judged. `all\n"
      "nodes` also counts the nodes behind the nearest hit.\n\n"
      "| thesis and follow-up paper | here | holds |\n"
      "| --- | --- | --- |\n";
  for (const Finding& finding : findings(results))
    text += fmt::format("| {} | {} | {} |\n", finding.claim, finding.found,
                        finding.holds ? "yes" : "no");
  return text + "\n";
}

}  // namespace pah
