#include "report/inspect/ray_costs.hpp"

#include <algorithm>

#include "base/parallel_for.hpp"
#include "bvh/bvh.hpp"
#include "render/path/camera_rays.hpp"

namespace pah {

PictureCosts measure_costs(const Bvh& bvh, const Camera& camera, const FilmSettings& film) {
  const CameraRays camera_rays(camera, film);
  const auto width = static_cast<std::size_t>(film.width);
  PictureCosts costs{film.width, film.height, {}};
  costs.rays.resize(width * static_cast<std::size_t>(film.height));
  parallel_for(static_cast<std::size_t>(film.height), 1, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < film.width; ++x) {
      // Traced alone, so that the counts are this ray's.
      const Ray ray = camera_rays.central(x, y);
      Hit hit;
      TraversalCounts counts;
      closest_hits(bvh, std::span(&ray, 1), std::span(&hit, 1), &counts);
      costs.rays[row * width + static_cast<std::size_t>(x)] = {
          static_cast<std::uint32_t>(counts.nodes), static_cast<std::uint32_t>(counts.triangles),
          hit.valid()};
    }
  });
  return costs;
}

CostSummary summarize(const PictureCosts& costs) {
  CostSummary sum;
  std::uint64_t nodes = 0, triangles = 0;
  for (const RayCost& ray : costs.rays) {
    sum.hits += ray.hit ? 1 : 0;
    nodes += ray.nodes;
    triangles += ray.triangles;
    sum.max_nodes = std::max(sum.max_nodes, ray.nodes);
    sum.max_triangles = std::max(sum.max_triangles, ray.triangles);
  }
  sum.rays = costs.rays.size();
  if (sum.rays > 0) {
    sum.nodes_per_ray = static_cast<double>(nodes) / static_cast<double>(sum.rays);
    sum.triangles_per_ray = static_cast<double>(triangles) / static_cast<double>(sum.rays);
  }
  return sum;
}

}  // namespace pah
