#include "report/study/local.hpp"

#include "accel/bundle_measure.hpp"

namespace pah {

StudySite make_site(const StudyMesh& mesh, const Aabb& bounds, StudyArea area, std::uint64_t rays,
                    std::uint64_t seed) {
  StudySite site{mesh, std::move(area), bounds, {}, {}};
  const RegionShape shape = shape_of(region_of(site.area.area));
  const Triangles triangles = mesh.triangles();
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (overlaps(shape, triangles[i].bounds()))
      site.subset.push_back(static_cast<std::uint32_t>(i));
  site.rays = draw_rays(site.area.area, rays, seed);
  return site;
}

BuiltBvh build_local(const StudySite& site, const LocalConfig& config) {
  const InfluenceArea& area = site.area.area;
  const BundleAxes axes(area, config.split, config.facing_threshold);
  if (config.heuristic == LocalHeuristic::surface_area)
    return build_bvh_and_tree(site.mesh.triangles(), site.subset, config.build,
                              LocalSurfaceArea{axes});
  return build_bvh_and_tree(site.mesh.triangles(), site.subset, config.build,
                            LocalProjectedArea{axes, HitProbability(area)});
}

}  // namespace pah
