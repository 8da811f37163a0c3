#include "report/stats.hpp"

#include <sys/resource.h>

#include "report/json.hpp"

namespace pah {
namespace {

template <typename Value>
OrderedJson by_ray_kind(const Value& value) {
  OrderedJson json = OrderedJson::object();
  for (std::size_t kind = 0; kind < ray_kind_names.size(); ++kind)
    json[std::string(ray_kind_names[kind])] = value(kind);
  return json;
}

OrderedJson traversal_json(const RenderCounts& counts) {
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

OrderedJson areas_json(const std::vector<AreaReport>& areas) {
  OrderedJson json = OrderedJson::array();
  for (const AreaReport& area : areas)
    json.push_back({{"name", area.name},
                    {"type", area.type},
                    {"light", area.light},
                    {"triangles", area.triangles},
                    {"built", area.built},
                    {"reason", area.reason},
                    {"predicted_cost", json_or_null(area.predicted_cost)},
                    {"measured_cost", json_or_null(area.measured_cost)},
                    {"global_cost", json_or_null(area.global_cost)},
                    {"measured_global_cost", json_or_null(area.measured_global_cost)},
                    {"rays", json_or_null(area.rays)},
                    {"asked_rays", json_or_null(area.asked_rays)},
                    {"sampled_rays", json_or_null(area.sampled_rays)}});
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
  const OrderedJson json{
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
        {"confidence95", OrderedJson::array({report.error.low, report.error.high})}}},
      {"nan_samples", report.counts.nan_samples},
      {"warnings", report.warnings},
  };
  return text_of(json) + "\n";
}

}  // namespace pah
