// The local BVHs of the study.
#pragma once

#include "bvh/build.hpp"
#include "report/study/areas.hpp"
#include "report/study/study.hpp"
#include "report/study/work.hpp"

namespace pah {

// A mesh and one of its areas, with everything that all its trees share.
struct StudySite {
  const StudyMesh& mesh;
  StudyArea area;
  std::vector<std::uint32_t> subset;  // triangles that can be hit in the region
  std::vector<BundleRay> rays;

  [[nodiscard]] StudyTree on(const BinaryTree& tree, const BuildConfig& config) const {
    return {tree, mesh.triangles(), subset, config.side_by_side};
  }
  [[nodiscard]] StudyCase named(const LocalConfig& config) const {
    return {mesh.name, area.name, area.group, subset.size(), config.heuristic, config.split};
  }
};

[[nodiscard]] StudySite make_site(const StudyMesh& mesh, StudyArea area, std::uint64_t rays,
                                  std::uint64_t seed);

[[nodiscard]] BuiltBvh build_local(const StudySite& site, const LocalConfig& config);

// The experiments at one site; each adds rows to the results.
void study_prediction(const StudySite& site, StudyResults& results);
void study_cost(const StudySite& site, const BuiltBvh& global,
                std::span<const std::uint32_t> all_triangles, StudyResults& results);
void study_sweep(const StudySite& site, StudyResults& results);

}  // namespace pah
