// The study's tables in Markdown.
#include <fmt/format.h>

#include <algorithm>

#include "report/study/text/markdown_table.hpp"
#include "report/study/text/means.hpp"

namespace pah {
namespace {

std::string percent(double x) { return std::isnan(x) ? "-" : fmt::format("{:.1f} %", 100 * x); }
std::string number(double x) { return std::isnan(x) ? "-" : fmt::format("{:.3f}", x); }

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
  return markdown_row({markdown_cell(name), error(&PredictionRow::pah),
                       error(&PredictionRow::pah_plane), error(&PredictionRow::pah_unclipped),
                       error(&PredictionRow::sah), share(&PredictionRow::standard_error),
                       share(&PredictionRow::closest)});
}

std::string predictions(const StudyResults& results) {
  std::string text =
      "## Prediction\n\n"
      "Each heuristic predicts the cost of a ray that meets the root's box. The measured cost is\n"
      "the mean over the rays of the bundle; it counts every node that a ray meets within the\n"
      "region, also behind its nearest hit. The table shows the mean error,\n"
      "|predicted - measured| / measured, over the trees built by SAH and by PAH.\n\n"
      "`PAH` clips boxes to the region and measures them as the rays are distributed (for points,\n"
      "by solid angle). `plane measure` measures them in the picture plane instead. `unclipped`\n"
      "ignores the borders of the region. `noise` is the standard error of the measured mean.\n"
      "`nearest hit` is the share of the measured cost that remains if the search stops at the\n"
      "nearest hit; no heuristic here takes this into account.\n\n";
  text += markdown_header({"", "PAH", "plane measure", "unclipped", "SAH", "noise", "nearest hit"});
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
std::string variants_row(const std::string& name, const std::vector<CostRow>& rows,
                         const Take& take, double CostRow::*value) {
  std::vector<std::string> cells{markdown_cell(name)};
  for (const StudyVariant& variant : study_variants)
    cells.push_back(number(mean_of(
        rows, [&](const CostRow& row) { return variant.built(row) && take(row); },
        [value](const CostRow& row) { return row.*value; })));
  return markdown_row(cells);
}

std::string variants_table(const StudyResults& results, const std::vector<CostRow>& rows,
                           double CostRow::*value) {
  std::vector<std::string> names{""};
  for (const StudyVariant& variant : study_variants) names.push_back(variant.name());
  std::string text = markdown_header(names);
  text += variants_row("**all**", rows, anything, value);
  for (std::size_t group = 0; group < study_groups; ++group)
    text += variants_row(name_of(static_cast<StudyGroup>(group)), rows, of_group(group), value);
  for (const std::string& mesh : meshes_of(results))
    text += variants_row(mesh, rows, of_mesh(mesh), value);
  return text + "\n";
}

std::string relative_table(const StudyResults& results, const StudyVariant& base,
                           double CostRow::*value) {
  return variants_table(results, relative_costs(results.costs, base, value), value);
}

std::string costs(const StudyResults& results) {
  std::string text =
      "## Cost of the trees\n\n"
      "The cost of searching for the nearest hits of the bundle's rays within the region, in the\n"
      "binary tree. This is what a renderer pays. The table shows means relative to SAH + longest\n"
      "axis; below 1 is better.\n\n";
  text += relative_table(results, sah_longest, &CostRow::closest);
  text += "Relative to SAH + best axis:\n\n";
  text += relative_table(results, sah_best, &CostRow::closest);
  text +=
      "The cost of all nodes that rays meet within the region, also behind the nearest hit,\n"
      "relative to SAH + longest axis. This is what heuristics minimize, and the cost of rays "
      "that\n"
      "hit nothing:\n\n";
  text += relative_table(results, sah_longest, &CostRow::all);
  text +=
      "The cost of nearest hits as the renderer's own kernels count it, with eight children per\n"
      "node and blocks of triangles, relative to SAH + best axis:\n\n";
  return text + relative_table(results, sah_best, &CostRow::kernel);
}

std::string break_even(const StudyResults& results) {
  std::string text =
      "## Break-even\n\n"
      "A ray without a hit in its local BVH may have to traverse the global BVH as well. So a "
      "local\n"
      "BVH pays only if the share of rays that hit in it exceeds its cost divided by the cost of\n"
      "the global BVH (SAH + best axis) for the same rays. The table shows this quotient:\n\n";
  text += variants_table(results, results.costs, &CostRow::break_even);
  text += "The actual share of the bundles' rays that hit within the region:\n\n";
  text += markdown_header({"", "hit"});
  const auto share = [&](const std::string& name, const auto& take) {
    return markdown_row(
        {markdown_cell(name),
         number(mean_of(results.costs, take, [](const CostRow& row) { return row.hit_share; }))});
  };
  text += share("**all**", anything);
  for (std::size_t group = 0; group < study_groups; ++group)
    text += share(name_of(static_cast<StudyGroup>(group)), of_group(group));
  for (const std::string& mesh : meshes_of(results)) text += share(mesh, of_mesh(mesh));
  return text + "\n";
}

std::string balance(const StudyResults& results) {
  std::string text =
      "## Balance\n\n"
      "The share of lopsided nodes: of all nodes with at least 64 triangles, those whose smaller\n"
      "child has less than a sixteenth of the triangles.\n\n";
  text += variants_table(results, results.costs, &CostRow::lopsided);
  text +=
      "The mean depth of leaves, relative to a balanced tree with the same number of leaves:\n\n";
  return text + variants_table(results, results.costs, &CostRow::mean_depth);
}

std::string builds(const StudyResults& results) {
  return "## Building\n\n"
         "The CPU time of building, relative to SAH + best axis. Unlike costs, times are measured\n"
         "and vary from run to run.\n\n" +
         relative_table(results, sah_best, &CostRow::build_seconds);
}

std::string sweeps(const StudyResults& results) {
  std::string text =
      "## Parameters\n\n"
      "One parameter varies at a time; the others keep their defaults (16 bins, leaves of up to 8\n"
      "triangles, no further rules for leaves, no fallback, facing threshold 0.5, ratios 2 and 0,\n"
      "no least share). The table shows the cost of nearest hits relative to the default, as the\n"
      "mean over the meshes; `inf` means never. The facing threshold and the ratios are varied\n"
      "with SPFH, the least share with the longest axis, all others with the best axis. Rules for\n"
      "leaves are tested with leaves of up to 32 triangles.\n\n";
  std::vector<std::string> areas;
  std::vector<std::pair<std::string, double>> settings;
  for (const SweepRow& row : results.sweeps) {
    if (std::ranges::find(areas, row.tree.area) == areas.end()) areas.push_back(row.tree.area);
    const std::pair<std::string, double> setting{row.parameter, row.value};
    if (std::ranges::find(settings, setting) == settings.end()) settings.push_back(setting);
  }
  std::vector<std::string> names{""};
  for (const std::string& area : areas)
    for (const char* heuristic : {"SAH", "PAH"})
      names.push_back(fmt::format("{}, {}", heuristic, area));
  text += markdown_header(names);
  for (const auto& [parameter, value] : settings) {
    std::vector<std::string> cells{fmt::format("{} {:g}", parameter, value)};
    for (const std::string& area : areas)
      for (const Heuristic heuristic : {Heuristic::surface_area, Heuristic::projected_area})
        cells.push_back(number(mean_of(
            results.sweeps,
            [&, name = parameter, setting = value](const SweepRow& row) {
              return row.tree.heuristic == heuristic && row.tree.area == area &&
                     row.parameter == name && row.value == setting;
            },
            [](const SweepRow& row) { return row.over_default; })));
    text += markdown_row(cells);
  }
  return text + "\n";
}

}  // namespace

std::string study_markdown(const StudyResults& results, bool with_plots) {
  std::string text = fmt::format(
      "# Study of local BVHs\n\n"
      "{} rays per area, seed {}{}. Costs are counted: {:g} for a box test, {:g} for a test of up\n"
      "to {} triangles side by side. They depend on the seed alone; the times and the rays per\n"
      "second at the end also depend on the machine. Influence areas are half as wide as the\n"
      "bounding sphere of their mesh, so that they cut through it. Rays start at the near face or\n"
      "the eye of the area. All rows are in prediction.csv, cost.csv, build.csv and sweep.csv.\n\n",
      results.config.rays, results.config.seed, results.config.quick ? ", quick" : "", box_cost,
      triangle_cost, BuildConfig{}.side_by_side);
  if (results.skipped_areas > 0)
    text +=
        fmt::format("Left out: {} areas in which no ray meets a box.\n\n", results.skipped_areas);
  if (results.costs.empty()) return text + rates_markdown(results, with_plots);
  text += study_findings(results);
  if (with_plots)
    text +=
        "![Errors of the predictions](prediction.svg)\n![Costs by area](cost.svg)\n"
        "![Bins and leaves](sweep.svg)\n\n";
  else
    text +=
        "No plots: gnuplot was not found or failed. Its scripts are here: run gnuplot *.gp.\n\n";
  return text + predictions(results) + costs(results) + break_even(results) + balance(results) +
         builds(results) + sweeps(results) + rates_markdown(results, with_plots);
}

}  // namespace pah
