// The study's rows as CSV, for other tools.
#include <fmt/format.h>

#include "report/study/study.hpp"

namespace pah {
namespace {

// Quotes a text for CSV (RFC 4180).
std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

constexpr const char* case_columns = "mesh,area,group,triangles,heuristic,split";

std::string cells(const StudyCase& tree) {
  return fmt::format("{},{},{},{},{},{}", csv_text(tree.mesh), csv_text(tree.area),
                     csv_text(name_of(tree.group)), tree.triangles, label_of(tree.heuristic),
                     label_of(tree.split));
}

}  // namespace

std::string prediction_csv(const StudyResults& results) {
  std::string csv = fmt::format(
      "{},measured,standard_error,closest_hit,pah,pah_plane_measure,pah_unclipped,sah\n",
      case_columns);
  for (const PredictionRow& row : results.predictions)
    csv += fmt::format("{},{:.6g},{:.3g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", cells(row.tree),
                       row.measured, row.standard_error, row.closest, row.pah, row.pah_plane,
                       row.pah_unclipped, row.sah);
  return csv;
}

std::string cost_csv(const StudyResults& results) {
  std::string csv = fmt::format(
      "{},closest_hit,all_nodes,kernel,hit_share,break_even_share,mean_depth,max_depth,"
      "lopsided\n",
      case_columns);
  for (const CostRow& row : results.costs)
    csv += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.5g},{:.5g},{:.5g},{},{:.5g}\n", cells(row.tree),
                       row.closest, row.all, row.kernel, row.hit_share, row.break_even,
                       row.mean_depth, row.max_depth, row.lopsided);
  return csv;
}

std::string build_csv(const StudyResults& results) {
  std::string csv = fmt::format("{},build_cpu_seconds\n", case_columns);
  for (const CostRow& row : results.costs)
    csv += fmt::format("{},{:.6f}\n", cells(row.tree), row.build_seconds);
  return csv;
}

std::string sweep_csv(const StudyResults& results) {
  std::string csv = fmt::format("{},parameter,value,cost,over_default,lopsided\n", case_columns);
  for (const SweepRow& row : results.sweeps)
    csv += fmt::format("{},{},{:g},{:.6g},{:.5g},{:.5g}\n", cells(row.tree), row.parameter,
                       row.value, row.cost, row.over_default, row.lopsided);
  return csv;
}

std::string rays_csv(const StudyResults& results) {
  std::string csv =
      "scene,triangles,ray_kind,accelerator,batch,threads,repetition,rays_per_second,"
      "nodes_per_ray,triangles_per_ray,build_seconds,bytes,mismatches\n";
  const auto counted = [](const std::optional<double>& count) {
    return count ? fmt::format("{:.5g}", *count) : std::string();
  };
  for (const RateRow& row : results.rates)
    csv +=
        fmt::format("{},{},{},{},{:.6g},{},{},{:.6g},{},{},{:.6f},{},{}\n", csv_text(row.scene),
                    row.triangles, row.ray_kind, row.accelerator, row.batch, row.threads,
                    row.repetition, row.rays_per_second, counted(row.nodes_per_ray),
                    counted(row.triangles_per_ray), row.build_seconds, row.bytes, row.mismatches);
  return csv;
}

}  // namespace pah
