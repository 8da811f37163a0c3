#include "report/study/study.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <sstream>

#include "catch.hpp"
#include "report/study/text/means.hpp"
#include "support/soups.hpp"

using namespace pah;

namespace {

StudyResults small_study(std::uint64_t seed) {
  std::vector<StudyMesh> meshes;
  for (const test::Soup& soup : {test::random_soup(300, 0.2F, Vec3{0}, 3), test::grid(10, 2.0F, 6)})
    meshes.push_back({soup.name, soup.positions, soup.indices});
  meshes.front().name = "a \"soup\", with a comma";
  StudyConfig config;
  config.quick = true;
  config.rays = 500;
  config.seed = seed;
  return run_study(meshes, config);
}

// Counts the columns of a line without quotes.
std::size_t columns(const std::string& line) {
  return 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
}

void check_table(const std::string& csv, const std::string& first_line, std::size_t rows) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  CHECK(line == first_line);
  std::size_t found = 0;
  std::size_t wrong = 0;
  while (std::getline(lines, line)) {
    ++found;
    // Removes quoted cells with their commas.
    std::string plain;
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (!quoted) plain += c;
    }
    wrong += columns(plain) != columns(first_line) ? 1 : 0;
    wrong += plain.find("nan") != std::string::npos ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(found == rows);
}

}  // namespace

TEST_CASE("The study's tables have their columns, a row for each tree") {
  const StudyResults results = small_study(1);
  CHECK(results.skipped_areas == 0);
  const std::size_t areas = 2 * 6;
  const std::string tree = "mesh,area,group,triangles,heuristic,split,";
  check_table(prediction_csv(results),
              tree + "measured,standard_error,closest_hit,pah,pah_plane_measure,pah_unclipped,sah",
              2 * areas);
  check_table(
      cost_csv(results),
      tree +
          "closest_hit,all_nodes,kernel,hit_share,break_even_share,mean_depth,max_depth,lopsided",
      9 * areas);
  check_table(build_csv(results), tree + "build_cpu_seconds", 9 * areas);
  check_table(sweep_csv(results), tree + "parameter,value,cost,over_default,lopsided",
              2 * (2 * 45));
  CHECK(cost_csv(results).find("\"a \"\"soup\"\", with a comma\",") != std::string::npos);
}

TEST_CASE("Relative costs are relative to what they say") {
  const StudyResults results = small_study(1);
  const auto by_longest = relative_costs(results.costs, sah_longest, &CostRow::closest);
  const auto by_best = relative_costs(results.costs, sah_best, &CostRow::closest);
  for (std::size_t i = 0; i < results.costs.size(); i += 9) {
    CHECK(by_longest[i].closest == 1);
    CHECK(results.costs[i].tree.split == SplitAxis::longest);
    CHECK(by_best[i + 1].closest == 1);
    CHECK(by_best[i].closest == Approx(results.costs[i].closest / results.costs[i + 1].closest));
    CHECK(results.costs[i + 1].tree.split == SplitAxis::best);
    for (std::size_t k = i; k < i + 9; ++k) CHECK(results.costs[k].break_even > 0);
  }
  for (const SweepRow& row : results.sweeps) {
    if (row.parameter == "bins" && row.value == BuildConfig{}.bins) CHECK(row.over_default == 1);
    if (row.parameter == "max_leaf" && row.value == BuildConfig{}.max_leaf)
      CHECK(row.over_default == 1);
    if (row.parameter == "facing_threshold" && row.value == FacingRules{}.threshold)
      CHECK(row.over_default == 1);
  }
}

TEST_CASE("The study depends on its seed, not on the threads") {
  const StudyResults results = small_study(1);
  const auto tables = [](const StudyResults& r) {
    return prediction_csv(r) + cost_csv(r) + sweep_csv(r);
  };
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(tables(small_study(1)) == tables(results));
  }
  CHECK(tables(small_study(2)) != tables(results));
}

TEST_CASE("The report has every section, and says when there are no plots") {
  const StudyResults results = small_study(1);
  const std::string text = study_markdown(results, false);
  for (const char* section :
       {"## Findings", "## Prediction", "## Cost of the trees", "## Break-even", "## Balance",
        "## Building", "## Parameters", "| PAH | plane measure | unclipped | SAH |"})
    CHECK(text.find(section) != std::string::npos);
  CHECK(text.find("No plots") != std::string::npos);
  CHECK(study_markdown(results, true).find("(cost.svg)") != std::string::npos);
  CHECK(text.find("nan") == std::string::npos);
}

TEST_CASE("A study of nothing is a report without tables") {
  const StudyResults none = run_study({}, {});
  CHECK(study_markdown(none, false).find("## ") == std::string::npos);
}
