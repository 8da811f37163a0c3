// The study as tables that people read.
#include <fmt/format.h>

#include <algorithm>

#include "report/study_means.hpp"

namespace pah {
namespace {

std::string percent(double x) { return std::isnan(x) ? "-" : fmt::format("{:.1f} %", 100 * x); }
std::string number(double x) { return std::isnan(x) ? "-" : fmt::format("{:.3f}", x); }

// Pipes would end a cell.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string row_of(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

std::string header(const std::vector<std::string>& cells) {
  std::vector<std::string> rule(cells.size(), "---:");
  rule.front() = "---";
  return row_of(cells) + row_of(rule);
}

constexpr auto anything = [](const auto&) { return true; };

auto of_mesh(const std::string& mesh) {
  return [mesh](const auto& row) { return row.tree.mesh == mesh; };
}
auto of_group(std::size_t group) {
  return [group](const auto& row) { return row.tree.group == static_cast<StudyGroup>(group); };
}

template <typename Take>
std::string prediction_row(const std::string& name, const StudyResults& results, const Take& take) {
  const auto error = [&](double PredictionRow::*prediction) {
    return percent(mean_of(results.predictions, take, [prediction](const PredictionRow& row) {
      return relative_error(row.*prediction, row);
    }));
  };
  const auto share = [&](double PredictionRow::*part) {
    return percent(mean_of(results.predictions, take,
                           [part](const PredictionRow& row) { return row.*part / row.measured; }));
  };
  return row_of({cell(name), error(&PredictionRow::pah), error(&PredictionRow::pah_plane),
                 error(&PredictionRow::pah_unclipped), error(&PredictionRow::sah),
                 share(&PredictionRow::standard_error), share(&PredictionRow::closest)});
}

std::string predictions(const StudyResults& results) {
  std::string text =
      "## Prediction\n\n"
      "The cost that is expected of a ray that meets the root, against the mean over the rays of\n"
      "the bundle: every node that they meet within the region, whatever they hit. Mean of\n"
      "|predicted - measured| / measured over trees built by SAH and by PAH.\n\n"
      "`PAH` is clipped to the region and uniform in what the rays are uniform in (solid angle\n"
      "for points), `plane measure` in the picture plane instead, `unclipped` ignores the "
      "region's\n"
      "borders. `noise` is the standard error of the measured mean. `nearest hit` is what a "
      "search\n"
      "that stops at the nearest hit visits of it: no heuristic here knows about that.\n\n";
  text += header({"", "PAH", "plane measure", "unclipped", "SAH", "noise", "nearest hit"});
  text += prediction_row("all plane areas", results,
                         [](const PredictionRow& row) { return !is_point(row.tree.group); });
  text += prediction_row("all point areas", results,
                         [](const PredictionRow& row) { return is_point(row.tree.group); });
  text += prediction_row("**all**", results, anything);
  for (std::size_t group = 0; group < study_groups; ++group)
    text += prediction_row(name_of(static_cast<StudyGroup>(group)), results, of_group(group));
  for (const std::string& mesh : meshes_of(results))
    text += prediction_row(mesh, results, of_mesh(mesh));
  return text + "\n";
}

template <typename Take>
std::string variants_row(const std::string& name, const StudyResults& results, const Take& take,
                         double CostRow::*value) {
  std::vector<std::string> cells{cell(name)};
  for (const StudyVariant& variant : study_variants)
    cells.push_back(number(mean_of(
        results.costs, [&](const CostRow& row) { return variant.built(row) && take(row); },
        [value](const CostRow& row) { return row.*value; })));
  return row_of(cells);
}

std::string variants_table(const StudyResults& results, double CostRow::*value) {
  std::vector<std::string> names{""};
  for (const StudyVariant& variant : study_variants) names.push_back(variant.name());
  std::string text = header(names);
  text += variants_row("**all**", results, anything, value);
  for (std::size_t group = 0; group < study_groups; ++group)
    text += variants_row(name_of(static_cast<StudyGroup>(group)), results, of_group(group), value);
  for (const std::string& mesh : meshes_of(results))
    text += variants_row(mesh, results, of_mesh(mesh), value);
  return text + "\n";
}

// The same rows with a value relative to that of SAH + best axis in the same area.
StudyResults over_sah_best(StudyResults results, double CostRow::*value) {
  const std::vector<CostRow> rows = results.costs;
  for (CostRow& row : results.costs) {
    const auto base = std::ranges::find_if(rows, [&](const CostRow& other) {
      return sah_best.built(other) && other.tree.mesh == row.tree.mesh &&
             other.tree.area == row.tree.area;
    });
    row.*value = (*base).*value > 0 ? row.*value / (*base).*value : 0;
  }
  return results;
}

std::string costs(const StudyResults& results) {
  std::string text =
      "## Cost of the trees\n\n"
      "Nearest hits of the bundle's rays within the region, with early termination, in the binary\n"
      "tree; means of the cost relative to SAH + longest axis. Below 1 is better.\n\n";
  text += variants_table(results, &CostRow::over_longest);
  text += "Relative to SAH + best axis:\n\n";
  text += variants_table(results, &CostRow::over_best);

  const StudyResults kernels = over_sah_best(results, &CostRow::kernel_cost);
  text +=
      "As the renderer's own kernels count it, in nodes that are eight children wide and blocks\n"
      "of triangles, relative to SAH + best axis:\n\n";
  return text + variants_table(kernels, &CostRow::kernel_cost);
}

std::string break_even(const StudyResults& results) {
  std::string text =
      "## Break-even\n\n"
      "A ray that finds nothing in its local BVH may have to ask the global one as well. So local\n"
      "BVHs pay only if the share of rays that hit locally exceeds (cost of the local BVH) /\n"
      "(cost of the global BVH, SAH + best axis, for the same rays). That share:\n\n";
  text += variants_table(results, &CostRow::break_even);
  text += "The share of the bundles' rays that do hit within the region:\n\n";
  text += header({"", "hit"});
  const auto share = [&](const std::string& name, const auto& take) {
    return row_of({cell(name), number(mean_of(results.costs, take,
                                              [](const CostRow& row) { return row.hit_share; }))});
  };
  text += share("**all**", anything);
  for (std::size_t group = 0; group < study_groups; ++group)
    text += share(name_of(static_cast<StudyGroup>(group)), of_group(group));
  for (const std::string& mesh : meshes_of(results)) text += share(mesh, of_mesh(mesh));
  return text + "\n";
}

std::string builds(const StudyResults& results) {
  const StudyResults relative = over_sah_best(results, &CostRow::build_seconds);
  return "## Building\n\n"
         "CPU seconds relative to SAH + best axis. These alone are measured, not counted.\n\n" +
         variants_table(relative, &CostRow::build_seconds);
}

std::string sweeps(const StudyResults& results) {
  std::string text =
      "## Parameters\n\n"
      "One at a time, the others at their defaults (16 bins, leaves of up to 8 triangles, facing\n"
      "threshold 0.5): nearest-hit cost relative to the default. Bins and leaves with the best\n"
      "axis, the threshold with SPFH.\n\n";
  text += header({"", "SAH", "PAH"});
  std::vector<std::pair<std::string, double>> done;
  for (const SweepRow& row : results.sweeps) {
    const std::pair<std::string, double> key{row.parameter, row.value};
    if (std::ranges::find(done, key) != done.end()) continue;
    done.push_back(key);
    const auto mean = [&](LocalHeuristic heuristic) {
      return number(mean_of(
          results.sweeps,
          [&](const SweepRow& other) {
            return other.tree.heuristic == heuristic && other.parameter == row.parameter &&
                   other.value == row.value;
          },
          [](const SweepRow& other) { return other.over_default; }));
    };
    text += row_of({fmt::format("{} {:g}", row.parameter, row.value),
                    mean(LocalHeuristic::surface_area), mean(LocalHeuristic::projected_area)});
  }
  return text + "\n";
}

}  // namespace

std::string study_markdown(const StudyResults& results, bool with_plots) {
  std::string text = fmt::format(
      "# Study of local BVHs\n\n"
      "{} rays an area, seed {}{}. Costs are counted: {:g} a box test, {:g} for up to {} "
      "triangles\n"
      "tested side by side. They depend on the seed alone. Areas are placed by the bounding "
      "sphere\n"
      "of a mesh and half as wide, so that they cut through it; rays start at the area's near "
      "face\n"
      "or eye. Rows: prediction.csv, cost.csv, build.csv, sweep.csv.\n\n",
      results.config.rays, results.config.seed, results.config.quick ? ", quick" : "", box_cost,
      triangle_cost, BuildConfig{}.side_by_side);
  if (results.skipped_areas > 0)
    text +=
        fmt::format("Left out: {} areas in which no ray meets a box.\n\n", results.skipped_areas);
  if (results.costs.empty()) return text;
  text += study_findings(results);
  if (with_plots)
    text +=
        "![Errors of the predictions](prediction.svg)\n![Costs by area](cost.svg)\n"
        "![Bins and leaves](sweep.svg)\n\n";
  else
    text +=
        "No plots: gnuplot was not found or failed. Its scripts are here: run gnuplot *.gp.\n\n";
  return text + predictions(results) + costs(results) + break_even(results) + builds(results) +
         sweeps(results);
}

}  // namespace pah
