#include "report/study/local.hpp"

#include "accel/local/build_local.hpp"

namespace pah {

StudySite make_site(const StudyMesh& mesh, StudyArea area, std::uint64_t rays, std::uint64_t seed) {
  StudySite site{mesh, std::move(area), {}, {}};
  site.subset = local_triangles(mesh.triangles(), site.area.area).subset;
  site.rays = draw_rays(site.area.area, rays, seed);
  return site;
}

BuiltBvh build_local(const StudySite& site, const LocalConfig& config) {
  return build_local(site.mesh.triangles(), site.subset, site.area.area, config);
}

}  // namespace pah
