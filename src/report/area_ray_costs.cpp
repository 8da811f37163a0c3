#include "report/area_ray_costs.hpp"

#include <optional>

#include "render/camera_rays.hpp"
#include "render/seen_point.hpp"

namespace pah {
namespace {

struct AskedRays {
  std::vector<Ray> nearest, any;  // hits that are searched for

  [[nodiscard]] std::size_t size() const { return nearest.size() + any.size(); }
};

// By area.
std::vector<AskedRays> rays_of(const World& world, const LocalBvhs& local, std::size_t areas,
                               const FilmSettings& film) {
  std::vector<AskedRays> asked(areas);
  const CameraRays camera_rays(world.camera, film);
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) {
      Ray ray = camera_rays.central(x, y);
      Hit hit;
      local.closest_hit({&ray, 1}, {&hit, 1});
      ray.bundle = camera_bundle;
      if (const auto area = local.area_of(ray)) asked[*area].nearest.push_back(ray);
      if (!hit.valid()) continue;
      const SeenPoint at = seen_point(world, ray, hit);
      for (std::size_t i = 0; i < world.lights.size(); ++i) {
        const std::optional<ExactBundle> bundle = exact_bundle(world.lights[i]);
        if (!bundle || !is_lit(at, *bundle)) continue;
        const Ray to_light = ray_to(at, *bundle, static_cast<LightId>(i));
        if (const auto area = local.area_of(to_light)) asked[*area].any.push_back(to_light);
      }
    }
  return asked;
}

// Of all rays together.
template <typename NearestHits, typename AnyHits>
double cost_of(const AskedRays& rays, const NearestHits& nearest_hits, const AnyHits& any_hits) {
  TraversalCounts counts;
  std::vector<Hit> hits(rays.nearest.size());
  nearest_hits(std::span(rays.nearest), std::span(hits), &counts);
  std::vector<std::uint8_t> occluded(rays.any.size());
  any_hits(std::span(rays.any), std::span(occluded), &counts);
  return traversal_cost(counts);
}

}  // namespace

std::vector<AreaRayCosts> measure_area_costs(const World& world, const Bvh& global,
                                             const std::vector<LocalArea>& areas,
                                             const LocalConfig& config, const FilmSettings& film) {
  if (areas.empty()) return {};
  const auto local = make_local_bvhs(world.triangles(), areas, config);
  const std::vector<AskedRays> asked = rays_of(world, *local, areas.size(), film);
  std::vector<AreaRayCosts> costs(areas.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    AreaRayCosts& of = costs[i];
    of.rays = asked[i].size();
    if (of.rays == 0) continue;
    const auto rays = static_cast<double>(of.rays);
    of.local = cost_of(
                   asked[i], [&](auto... arguments) { local->closest_hit(arguments...); },
                   [&](auto... arguments) { local->occluded(arguments...); }) /
               rays;
    of.global = cost_of(
                    asked[i], [&](auto... arguments) { closest_hits(global, arguments...); },
                    [&](auto... arguments) { occluded(global, arguments...); }) /
                rays;
  }
  const std::vector<LocalBvhUse> uses = local->uses();
  for (std::size_t i = 0; i < areas.size(); ++i) costs[i].answered = uses[i].answered;
  return costs;
}

}  // namespace pah
