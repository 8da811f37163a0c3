#include "report/stats.hpp"

#include <sys/resource.h>

#include "report/json_value.hpp"

namespace pah {
namespace {

template <typename Value>
JsonValue by_ray_kind(const Value& value) {
  JsonValue json = JsonValue::object();
  for (std::size_t kind = 0; kind < ray_kind_names.size(); ++kind)
    json.set(ray_kind_names[kind], value(kind));
  return json;
}

JsonValue traversal_json(const RenderCounts& counts) {
  const auto per_ray = [&](std::uint64_t TraversalCounts::*member) {
    return by_ray_kind([&, member](std::size_t kind) {
      const auto rays = counts.rays[kind];
      return rays == 0
                 ? 0.0
                 : static_cast<double>(counts.traversal[kind].*member) / static_cast<double>(rays);
    });
  };
  return {{"nodes_per_ray", per_ray(&TraversalCounts::nodes)},
          {"triangles_per_ray", per_ray(&TraversalCounts::triangles)}};
}

JsonValue areas_json(const std::vector<AreaReport>& areas) {
  JsonValue json = JsonValue::array();
  for (const AreaReport& area : areas)
    json.push_back({{"name", area.name},
                    {"type", area.type},
                    {"light", area.light},
                    {"triangles", area.triangles},
                    {"built", area.built},
                    {"reason", area.reason},
                    {"predicted_cost", area.predicted_cost},
                    {"measured_cost", area.measured_cost},
                    {"global_cost", area.global_cost},
                    {"measured_global_cost", area.measured_global_cost},
                    {"rays", area.rays},
                    {"asked_rays", area.asked_rays},
                    {"sampled_rays", area.sampled_rays}});
  return json;
}

}  // namespace

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
  return static_cast<std::uint64_t>(usage.ru_maxrss);
#else
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
#endif
}

std::string stats_json(const RenderReport& report) {
  const AcceleratorMemory& structures = report.accelerator_bytes;
  const JsonValue json{
      {"version", report.version},
      {"scene", report.scene},
      {"width", report.width},
      {"height", report.height},
      {"samples", report.samples},
      {"mean_samples", report.mean_samples},
      {"threads", report.threads},
      {"seed", report.seed},
      {"accelerator", report.accelerator},
      {"triangles", report.triangles},
      {"seconds",
       {{"load", report.seconds.load},
        {"build", report.seconds.build},
        {"render", report.seconds.render},
        {"total", report.seconds.total}}},
      {"rays", by_ray_kind([&](std::size_t kind) { return report.counts.rays[kind]; })},
      {"traversal", traversal_json(report.counts)},
      {"influence_areas", areas_json(report.influence_areas)},
      {"light_grids", grids_json(report.light_grids)},
      {"memory_bytes",
       {{"scene", report.scene_bytes},
        {"global_bvh", structures.global_bvh},
        {"local_bvhs", structures.local_bvhs},
        {"light_grids", structures.light_grids},
        {"top_level", structures.top_level},
        {"film", report.film_bytes}}},
      {"peak_memory_bytes", peak_memory_bytes()},
      {"error",
       {{"mse", report.error.mse},
        {"relmse", report.error.relmse},
        {"confidence95", JsonValue::array({report.error.low, report.error.high})}}},
      {"nan_samples", report.counts.nan_samples},
      {"warnings", report.warnings},
  };
  return json.indented_text() + "\n";
}

}  // namespace pah
