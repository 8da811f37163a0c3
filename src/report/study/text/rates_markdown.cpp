// The tables of rays per second in Markdown.
#include <algorithm>
#include <cmath>

#include "accel/embree_version.hpp"
#include "bvh/instruction_set.hpp"
#include "report/study/rates/answers.hpp"
#include "report/study/text/markdown_table.hpp"
#include "report/study/text/means.hpp"
#include "report/study/text/rate_summary.hpp"

namespace pah {
namespace {

struct Comparison {
  const char *accelerator, *base;

  [[nodiscard]] std::string name() const { return fmt::format("{} / {}", accelerator, base); }
};

bool has(const std::vector<RateRow>& rows, const char* accelerator) {
  return std::ranges::find(rows, accelerator, &RateRow::accelerator) != rows.end();
}

std::vector<const char*> accelerators_of(const std::vector<RateRow>& rows) {
  std::vector<const char*> names;
  for (const char* name : rate_accelerators)
    if (has(rows, name)) names.push_back(name);
  return names;
}

std::vector<Comparison> comparisons_of(const std::vector<RateRow>& rows) {
  std::vector<Comparison> all;
  for (const Comparison comparison :
       {Comparison{"bvh", "embree"}, Comparison{"bvh", "embree16"}, Comparison{"local", "bvh"},
        Comparison{"light", "bvh"}, Comparison{"light", "embree16"}})
    if (has(rows, comparison.accelerator) && has(rows, comparison.base)) all.push_back(comparison);
  return all;
}

std::string ratio_cell(double ratio) {
  return std::isnan(ratio) ? "-" : fmt::format("{:.2f}", ratio);
}

std::string spread_cell(const RateSpread& spread) {
  if (std::isnan(spread.median)) return "-";
  return fmt::format("{:.2f} ({:.2f}-{:.2f})", 1e-6 * spread.median, 1e-6 * spread.least,
                     1e-6 * spread.most);
}

template <typename Take>
std::string means_row(const std::string& name, const std::vector<RateRow>& rows,
                      const std::vector<RateCase>& cases, const Take& take) {
  std::vector<std::string> cells{name, ""};
  cells.resize(2 + accelerators_of(rows).size());
  for (const Comparison& comparison : comparisons_of(rows)) {
    std::vector<double> ratios;
    for (const RateCase& of : cases) {
      if (!take(of)) continue;
      const double ratio = ratio_of(rows, of, comparison.accelerator, comparison.base);
      if (!std::isnan(ratio)) ratios.push_back(ratio);
    }
    cells.push_back(ratio_cell(std::exp(mean_of(
        ratios, [](double) { return true; }, [](double ratio) { return std::log(ratio); }))));
  }
  return markdown_row(cells);
}

std::string rates_table(const std::vector<RateRow>& rows, const std::vector<RateCase>& cases) {
  std::vector<std::string> names{"scene", "rays"};
  for (const char* name : accelerators_of(rows)) names.emplace_back(name);
  for (const Comparison& comparison : comparisons_of(rows)) names.push_back(comparison.name());
  std::string text = markdown_header(names);
  std::vector<std::string> kinds;
  for (const RateCase& of : cases) {
    std::vector<std::string> cells{markdown_cell(of.scene), of.ray_kind};
    for (const char* name : accelerators_of(rows))
      cells.push_back(spread_cell(spread_of(rows, of, name)));
    for (const Comparison& comparison : comparisons_of(rows))
      cells.push_back(ratio_cell(ratio_of(rows, of, comparison.accelerator, comparison.base)));
    text += markdown_row(cells);
    if (std::ranges::find(kinds, of.ray_kind) == kinds.end()) kinds.push_back(of.ray_kind);
  }
  if (comparisons_of(rows).empty()) return text + "\n";
  for (const std::string& kind : kinds)
    text += means_row("geometric mean, " + kind, rows, cases,
                      [&](const RateCase& of) { return of.ray_kind == kind; });
  text += means_row("**geometric mean of all**", rows, cases, [](const RateCase&) { return true; });
  return text + "\n";
}

// Returns a row for each accelerator of a scene.
std::string structures_table(const std::vector<RateRow>& rows) {
  std::string text = markdown_header(
      {"scene", "triangles", "accelerator", "build, seconds", "MB", "answers that differ"});
  std::vector<std::pair<std::string, std::string>> done;
  for (const RateRow& row : rows) {
    const std::pair<std::string, std::string> structure{row.scene, row.accelerator};
    if (std::ranges::find(done, structure) != done.end()) continue;
    done.push_back(structure);
    std::string mismatches;
    for (const RateRow& other : rows)
      if (other.scene == row.scene && other.accelerator == row.accelerator && other.threads == 1 &&
          other.repetition == 1 && other.mismatches > 0)
        mismatches += fmt::format("{}{} {}", mismatches.empty() ? "" : ", ", other.mismatches,
                                  other.ray_kind);
    text += markdown_row({markdown_cell(row.scene), fmt::format("{}", row.triangles),
                          row.accelerator, fmt::format("{:.3f}", row.build_seconds),
                          fmt::format("{:.2f}", 1e-6 * static_cast<double>(row.bytes)),
                          mismatches.empty() ? "0" : mismatches});
  }
  return text + "\n";
}

}  // namespace

std::string rates_markdown(const StudyResults& results, bool with_plots) {
  const std::vector<RateRow>& rows = results.rates;
  if (rows.empty()) return "";
  unsigned repetitions = 0;
  for (const RateRow& row : rows) repetitions = std::max(repetitions, row.repetition);
  std::string text = fmt::format(
      "## Rays a second\n\n"
      "The rays were recorded, in their batches, from a render of some tiles of each scene: at\n"
      "most about {} thousand of each kind. Meshes stand on a floor, under a bulb and a sun.\n"
      "`shadow to a point or sun` are the shadow rays to lights that may have a grid; the\n"
      "accelerator `light` has a grid for each of these lights. `embree16` is Embree searching "
      "for\n"
      "any hit in packets of 16 rays. The table shows millions of rays per second: the median of\n"
      "{} repetitions, with minimum and maximum in parentheses. Accelerators take turns in each\n"
      "repetition, and a ratio is the median over the repetitions. All rows are in rays.csv.\n"
      "Measured with {}{}{}.\n\n",
      results.config.quick ? 10 : 100, repetitions, instruction_set(),
      has_embree() ? " and Embree " : "; there is no Embree", embree_version());
  if (with_plots) text += "![Rays a second](rays.svg)\n\n";
  const std::vector<RateCase> all = cases_of(rows);
  std::vector<unsigned> thread_counts;
  for (const RateCase& of : all)
    if (std::ranges::find(thread_counts, of.threads) == thread_counts.end())
      thread_counts.push_back(of.threads);
  for (const unsigned threads : thread_counts) {
    std::vector<RateCase> cases;
    std::ranges::copy_if(all, std::back_inserter(cases),
                         [&](const RateCase& of) { return of.threads == threads; });
    text += threads == 1 ? "On 1 thread, in CPU time:\n\n"
                         : fmt::format("On {} threads, in wall-clock time:\n\n", threads);
    text += rates_table(rows, cases);
  }
  text += fmt::format(
      "The accelerators. Build times are wall-clock seconds with all threads. An answer differs\n"
      "from that of `bvh` if only one of the two hits, or if the nearest triangles differ and\n"
      "their distances differ by more than {:g} of the distance. Embree has another ray-triangle\n"
      "test, so a few differences are expected.\n\n",
      tie);
  return text + structures_table(rows);
}

}  // namespace pah
