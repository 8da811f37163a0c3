#include "report/study/study.hpp"

#include <numeric>

#include "report/study/local.hpp"

namespace pah {
namespace {

// The sweep builds a tree for each value, so it uses only areas where the heuristics differ most.
bool is_swept(const StudyArea& area, bool quick) {
  return area.name == "plane oblique" ||
         (!quick && (area.name == "plane y" || area.name == "plane 45" ||
                     area.name == "point near, oblique"));
}

}  // namespace

StudyResults run_study(const std::vector<StudyMesh>& meshes, const StudyConfig& config,
                       const std::function<void(double, const std::string&)>& progress) {
  StudyResults results;
  results.config = config;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const StudyMesh& mesh = meshes[m];
    const Aabb bounds = bounds_of(mesh.triangles());
    std::vector<std::uint32_t> all(mesh.indices.size());
    std::iota(all.begin(), all.end(), 0U);
    const BuiltBvh global = build_bvh(mesh.triangles(), all);
    const std::vector<StudyArea> areas = study_areas(bounds, config.quick);
    for (std::size_t a = 0; a < areas.size(); ++a) {
      if (progress) {
        const double done = static_cast<double>(a) / static_cast<double>(areas.size());
        progress((static_cast<double>(m) + done) / static_cast<double>(meshes.size()),
                 mesh.name + ", " + areas[a].name);
      }
      // Each area of a mesh has its own rays; the same area of two meshes may share them.
      const StudySite site = make_site(mesh, areas[a], config.rays, config.seed + a);
      study_prediction(site, results);
      if (!(results.predictions.back().measured > 0)) {
        results.predictions.resize(results.predictions.size() - 2);
        ++results.skipped_areas;
        continue;
      }
      study_cost(site, global, all, results);
      if (is_swept(areas[a], config.quick)) study_sweep(site, results);
    }
  }
  return results;
}

}  // namespace pah
