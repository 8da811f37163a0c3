#include <pah/render/acceleration.hpp>

#include "report/stats.hpp"

namespace pah {

std::vector<AreaReport> report_areas(const Acceleration& acceleration) {
  std::vector<AreaReport> reports;
  const std::vector<LocalBvhUse> uses =
      acceleration.local != nullptr ? acceleration.local->uses() : std::vector<LocalBvhUse>{};
  for (const auto& [area, plan, built] : acceleration.areas) {
    AreaReport report;
    report.name = area.name;
    report.type = type_name(area.area);
    report.light = area.light;
    report.built = plan.build;
    report.reason = plan.reason;
    if (built) {
      const LocalBvhReport& bvh_report = acceleration.local->reports()[*built];
      const LocalBvhUse& use = uses[*built];
      report.triangles = bvh_report.triangles;
      report.predicted_cost = bvh_report.predicted_cost;
      report.global_cost = bvh_report.global_cost;
      report.rays = use.answered;
      report.asked_rays = use.asked;
      report.sampled_rays = use.sampled;
      if (use.asked > 0) report.measured_cost = use.cost / static_cast<double>(use.asked);
      if (use.sampled > 0)
        report.measured_global_cost = use.global_cost / static_cast<double>(use.sampled);
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace pah
