#include "report/inspect/area_ray_costs.hpp"

#include <optional>

#include "render/path/camera_rays.hpp"
#include "render/surface/seen_point.hpp"

namespace pah {
namespace {

struct AskedRays {
  std::vector<Ray> nearest, any;  // hits that are searched for

  [[nodiscard]] std::size_t size() const { return nearest.size() + any.size(); }
};

// Collects the rays of a row of pixels, by area.
std::vector<AskedRays> rays_of(const World& world, const LocalBvhs& local, std::size_t areas,
                               const CameraRays& camera_rays, int width, int row) {
  std::vector<AskedRays> asked(areas);
  for (int x = 0; x < width; ++x) {
    const Ray ray = camera_rays.central(x, row);
    if (const auto area = local.area_of(ray)) asked[*area].nearest.push_back(ray);
    Hit hit;
    local.closest_hit({&ray, 1}, {&hit, 1});
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

// Adds the costs of all rays.
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
  const CameraRays camera_rays(world.camera, film);
  std::vector<AreaRayCosts> costs(areas.size());
  for (int row = 0; row < film.height; ++row) {
    const std::vector<AskedRays> asked =
        rays_of(world, *local, areas.size(), camera_rays, film.width, row);
    for (std::size_t i = 0; i < areas.size(); ++i) {
      if (asked[i].size() == 0) continue;
      AreaRayCosts& of = costs[i];
      of.rays += asked[i].size();
      of.local += cost_of(
          asked[i], [&](auto... arguments) { local->closest_hit(arguments...); },
          [&](auto... arguments) { local->occluded(arguments...); });
      of.global += cost_of(
          asked[i], [&](auto... arguments) { closest_hits(global, arguments...); },
          [&](auto... arguments) { occluded(global, arguments...); });
    }
  }
  const std::vector<LocalBvhUse> uses = local->uses();
  for (std::size_t i = 0; i < areas.size(); ++i) {
    AreaRayCosts& of = costs[i];
    of.answered = uses[i].answered;
    if (of.rays == 0) continue;
    of.local /= static_cast<double>(of.rays);
    of.global /= static_cast<double>(of.rays);
  }
  return costs;
}

}  // namespace pah
