#include "report/inspect/pictures/structure_map.hpp"

#include <algorithm>
#include <optional>

#include "base/parallel_for.hpp"
#include "render/path/camera_rays.hpp"
#include "render/surface/seen_point.hpp"

namespace pah {
namespace {

// The global BVH is gray; built areas and grids follow in their order.
std::vector<LegendColor> legend_of(const World& world, const Acceleration& acceleration) {
  std::vector<LegendColor> legend{legend_color("global BVH", 0)};
  for (const AreaStatus& status : acceleration.areas)
    if (status.built) legend.push_back(legend_color("area " + status.area.name, legend.size()));
  if (acceleration.grids != nullptr)
    for (const LightGridReport& grid : acceleration.grids->reports())
      legend.push_back(legend_color("grid of " + world.lights[grid.bundle].name, legend.size()));
  return legend;
}

class Structures {
 public:
  explicit Structures(const Acceleration& acceleration) : acceleration_(acceleration) {
    if (acceleration.grids != nullptr) grids_ = acceleration.grids->reports();
  }

  // Returns the structure's index in the legend.
  [[nodiscard]] std::size_t answering(const Ray& ray) const {
    if (acceleration_.local != nullptr) {
      const std::optional<std::size_t> area = acceleration_.local->area_of(ray);
      return area ? 1 + *area : 0;
    }
    const auto grid = std::ranges::find(grids_, ray.bundle, &LightGridReport::bundle);
    if (grid == grids_.end() || traverses(ray)) return 0;
    return 1 + static_cast<std::size_t>(grid - grids_.begin());
  }

 private:
  // Returns whether the ray needs a traversal: a look-up in a grid visits no node.
  [[nodiscard]] bool traverses(const Ray& ray) const {
    TraversalCounts counts;
    std::uint8_t occluded = 0;
    acceleration_.accelerator->occluded({&ray, 1}, {&occluded, 1}, &counts);
    return counts.inner_nodes > 0;
  }

  const Acceleration& acceleration_;
  std::vector<LightGridReport> grids_;
};

// The global BVH answers rays without a bundle.
Vec3 color_at(const SeenPoint& at, const World& world, const Structures& structures,
              const std::vector<LegendColor>& legend) {
  Vec3 sum(0);
  int rays = 0;
  for (std::size_t i = 0; i < world.lights.size(); ++i) {
    const std::optional<ExactBundle> bundle = exact_bundle(world.lights[i]);
    if (bundle && !is_lit(at, *bundle)) continue;
    const std::size_t structure =
        bundle ? structures.answering(ray_to(at, *bundle, static_cast<LightId>(i))) : 0;
    sum += legend[structure].color;
    ++rays;
  }
  return rays == 0 ? sum : sum / static_cast<float>(rays);
}

}  // namespace

StructureMap map_structures(const World& world, const Acceleration& acceleration,
                            const FilmSettings& film) {
  StructureMap map{{film.width, film.height, {}}, legend_of(world, acceleration)};
  const auto width = static_cast<std::size_t>(film.width);
  const auto height = static_cast<std::size_t>(film.height);
  map.image.pixels.resize(width * height, Vec3(0));
  const CameraRays camera_rays(world.camera, film);
  const Structures structures(acceleration);
  parallel_for(height, 1, [&](std::size_t row) {
    for (int x = 0; x < film.width; ++x) {
      const Ray ray = camera_rays.central(x, static_cast<int>(row));
      Hit hit;
      acceleration.accelerator->closest_hit({&ray, 1}, {&hit, 1});
      if (hit.valid())
        map.image.pixels[row * width + static_cast<std::size_t>(x)] =
            color_at(seen_point(world, ray, hit), world, structures, map.legend);
    }
  });
  return map;
}

}  // namespace pah
