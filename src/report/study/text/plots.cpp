// Plots by gnuplot. Each script holds its data, so that it can be changed and run again.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "base/output_file.hpp"
#include "report/study/text/means.hpp"
#include "report/study/text/rate_summary.hpp"

namespace pah {
namespace {

// Quotes a text for strings and data blocks of gnuplot.
std::string gnuplot_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const bool plain = static_cast<unsigned char>(c) >= ' ' && c != '"' && c != '\\';
    out += plain ? c : '_';
  }
  return out + '"';
}

std::string preamble(const char* name, const char* title, const char* y) {
  return fmt::format(
      "set terminal svg noenhanced size 900,450 background rgb 'white'\n"
      "set output '{}.svg'\n"
      "set title '{}'\n"
      "set ylabel '{}'\n"
      "set style data histograms\n"
      "set style fill solid 0.8 noborder\n"
      "set grid ytics\n"
      "set yrange [0:*]\n"
      "set key outside right top\n",
      name, title, y);
}

std::string prediction_plot(const StudyResults& results) {
  std::string text = preamble("prediction", "Mean relative error of the predicted cost", "%");
  text += "set xtics rotate by -20\n$errors << EOD\nmesh PAH \"PAH, unclipped\" SAH\n";
  for (const std::string& mesh : meshes_of(results)) {
    text += gnuplot_text(mesh);
    for (const auto prediction :
         {&PredictionRow::pah, &PredictionRow::pah_unclipped, &PredictionRow::sah})
      text += fmt::format(" {:.4g}",
                          100 * mean_of(
                                    results.predictions,
                                    [&](const PredictionRow& row) { return row.tree.mesh == mesh; },
                                    [&](const PredictionRow& row) {
                                      return relative_error(row.*prediction, row);
                                    }));
    text += "\n";
  }
  return text + "EOD\nplot for [i=2:4] $errors using i:xtic(1) title columnheader(i)\n";
}

std::string cost_plot(const StudyResults& results) {
  std::string text =
      preamble("cost", "Cost of nearest hits by area", "relative to SAH + longest axis");
  text += "set xtics rotate by -20\n$costs << EOD\ngroup";
  for (const StudyVariant& variant : study_variants) text += " " + gnuplot_text(variant.name());
  text += "\n";
  const std::vector<CostRow> rows = relative_costs(results.costs, sah_longest, &CostRow::closest);
  for (std::size_t g = 0; g < study_groups; ++g) {
    const auto group = static_cast<StudyGroup>(g);
    text += gnuplot_text(name_of(group));
    for (const StudyVariant& variant : study_variants) {
      const double mean = mean_of(
          rows, [&](const CostRow& row) { return variant.built(row) && row.tree.group == group; },
          [](const CostRow& row) { return row.closest; });
      text += std::isnan(mean) ? " ?" : fmt::format(" {:.4g}", mean);
    }
    text += "\n";
  }
  return text + fmt::format(
                    "EOD\nset datafile missing '?'\n"
                    "plot for [i=2:{}] $costs using i:xtic(1) title columnheader(i)\n",
                    1 + std::size(study_variants));
}

std::string sweep_plot(const StudyResults& results) {
  std::string text = preamble("sweep", "Parameters of the build", "cost relative to the default");
  text += "set xtics rotate by -20\n$costs << EOD\nparameter SAH PAH\n";
  std::vector<std::string> done;
  for (const SweepRow& row : results.sweeps) {
    const std::string name = fmt::format("{} {:g}", row.parameter, row.value);
    if (std::find(done.begin(), done.end(), name) != done.end()) continue;
    done.push_back(name);
    text += gnuplot_text(name);
    for (const Heuristic heuristic : {Heuristic::surface_area, Heuristic::projected_area})
      text += fmt::format(" {:.4g}", mean_of(
                                         results.sweeps,
                                         [&](const SweepRow& other) {
                                           return other.parameter == row.parameter &&
                                                  other.value == row.value &&
                                                  other.tree.heuristic == heuristic;
                                         },
                                         [](const SweepRow& other) { return other.over_default; }));
    text += "\n";
  }
  return text + "EOD\nplot for [i=2:3] $costs using i:xtic(1) title columnheader(i)\n";
}

// Plots medians on one thread, with bars from minimum to maximum.
std::string rays_plot(const StudyResults& results) {
  std::string text = preamble("rays", "Rays on one thread", "millions a second");
  text += "set xtics rotate by -35\nset style histogram errorbars gap 2 lw 1\n$rates << EOD\n";
  for (const RateCase& of : cases_of(results.rates)) {
    if (of.threads != 1) continue;
    text += gnuplot_text(of.scene + ", " + of.ray_kind);
    for (const char* accelerator : rate_accelerators) {
      const RateSpread spread = spread_of(results.rates, of, accelerator);
      text += std::isnan(spread.median) ? " ? ? ?"
                                        : fmt::format(" {:.4g} {:.4g} {:.4g}", 1e-6 * spread.median,
                                                      1e-6 * spread.least, 1e-6 * spread.most);
    }
    text += "\n";
  }
  text += "EOD\nset datafile missing '?'\nplot";
  for (std::size_t i = 0; i < rate_accelerators.size(); ++i)
    text += fmt::format("{} $rates using {}:{}:{}{} title '{}'", i > 0 ? "," : "", 3 * i + 2,
                        3 * i + 3, 3 * i + 4, i > 0 ? "" : ":xtic(1)", rate_accelerators[i]);
  return text + "\n";
}

// Runs `gnuplot script` in the folder, silently.
bool run_gnuplot(const std::filesystem::path& folder, std::string script) {
  posix_spawn_file_actions_t actions;
  if (::posix_spawn_file_actions_init(&actions) != 0) return false;
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "gnuplot";
  const std::array<char*, 3> arguments{program.data(), script.data(), nullptr};
  pid_t child = 0;
  const int error =
      ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return error == 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) &&
         WEXITSTATUS(status) == 0;
}

}  // namespace

bool write_study_plots(const StudyResults& results, const std::filesystem::path& folder) {
  if (results.costs.empty()) return false;
  std::vector<std::pair<const char*, std::string>> scripts{
      {"prediction.gp", prediction_plot(results)},
      {"cost.gp", cost_plot(results)},
      {"sweep.gp", sweep_plot(results)}};
  if (!results.rates.empty()) scripts.emplace_back("rays.gp", rays_plot(results));
  for (const auto& [name, text] : scripts) write_text_file(folder / name, text);
  bool all = true;
  for (const auto& [name, text] : scripts) all = run_gnuplot(folder, name) && all;
  return all;
}

}  // namespace pah
