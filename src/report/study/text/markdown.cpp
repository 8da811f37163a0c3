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
      "The cost that is expected of a ray that meets the root, against the mean over the rays of\n"
      "the bundle: every node that they meet within the region, whatever they hit. Mean of\n"
      "|predicted - measured| / measured over trees built by SAH and by PAH.\n\n"
      "`PAH` is clipped to the region and uniform in what the rays are uniform in (solid angle\n"
      "for points), `plane measure` in the picture plane instead, `unclipped` ignores the "
      "region's\n"
      "borders. `noise` is the standard error of the measured mean. `nearest hit` is what a "
      "search\n"
      "that stops at the nearest hit visits of it: no heuristic here knows about that.\n\n";
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
      "Nearest hits of the bundle's rays within the region, with early termination, in the binary\n"
      "tree: what a renderer pays. Means of the cost relative to SAH + longest axis; below 1 is\n"
      "better.\n\n";
  text += relative_table(results, sah_longest, &CostRow::closest);
  text += "Relative to SAH + best axis:\n\n";
  text += relative_table(results, sah_best, &CostRow::closest);
  text +=
      "Every node that rays meet within the region, whatever they hit, relative to SAH + longest\n"
      "axis. This is what heuristics minimize, and what rays cost that hit nothing:\n\n";
  text += relative_table(results, sah_longest, &CostRow::all);
  text +=
      "Nearest hits as the renderer's own kernels count them, in nodes that are eight children\n"
      "wide and blocks of triangles, relative to SAH + best axis:\n\n";
  return text + relative_table(results, sah_best, &CostRow::kernel);
}

std::string break_even(const StudyResults& results) {
  std::string text =
      "## Break-even\n\n"
      "A ray that finds nothing in its local BVH may have to ask the global one as well. So local\n"
      "BVHs pay only if the share of rays that hit locally exceeds (cost of the local BVH) /\n"
      "(cost of the global BVH, SAH + best axis, for the same rays). That share:\n\n";
  text += variants_table(results, results.costs, &CostRow::break_even);
  text += "The share of the bundles' rays that do hit within the region:\n\n";
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
      "The part of nodes, of those with 64 triangles and more, whose smaller child has less than\n"
      "a sixteenth of them:\n\n";
  text += variants_table(results, results.costs, &CostRow::lopsided);
  text += "Mean depth of leaves, over the least that a tree of so many leaves can have:\n\n";
  return text + variants_table(results, results.costs, &CostRow::mean_depth);
}

std::string builds(const StudyResults& results) {
  return "## Building\n\n"
         "CPU seconds relative to SAH + best axis. These alone are measured, not counted.\n\n" +
         relative_table(results, sah_best, &CostRow::build_seconds);
}

std::string sweeps(const StudyResults& results) {
  std::string text =
      "## Parameters\n\n"
      "One at a time, the others at their defaults (16 bins, leaves of up to 8 triangles, no rule\n"
      "for smaller ones, no fallback, facing threshold 0.5, ratios 2 and 0, no least share):\n"
      "nearest-hit cost relative to the default, mean over the meshes. `inf` is never. Facing and\n"
      "ratios with SPFH, the least share with the longest axis, all others with the best. Rules\n"
      "for leaves where these may have up to 32 triangles.\n\n";
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
      "{} rays an area, seed {}{}. Costs are counted: {:g} a box test, {:g} for up to {} "
      "triangles\n"
      "tested side by side. They depend on the seed alone; rays a second, at the end, do not. "
      "Areas\n"
      "are placed by the bounding sphere of a mesh and half as wide, so that they cut through it;\n"
      "rays start at the area's near face or eye. Rows: prediction.csv, cost.csv, build.csv,\n"
      "sweep.csv.\n\n",
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
