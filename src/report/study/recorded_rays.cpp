#include "report/study/recorded_rays.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <pah/render/render.hpp>
#include <random>

namespace pah {
namespace {

// As many as the benchmarks render: batches of 32 by 32 pixels, eight rays to a pixel.
constexpr int samples = 8;

// Stands between the renderer and an accelerator. For one thread.
class Recorder final : public Accelerator {
 public:
  Recorder(const World& world, const Accelerator& accelerator, RecordedRays& rays)
      : world_(world), accelerator_(accelerator), rays_(rays) {}

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    if (!rays.empty()) kind_of(rays).add(rays);
    accelerator_.closest_hit(rays, hits, counts);
  }
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    rays_.shadow.add(rays);
    accelerator_.occluded(rays, results, counts);
  }
  [[nodiscard]] AcceleratorMemory memory() const override { return accelerator_.memory(); }

 private:
  // Shadow rays are asked for nearest hits where surfaces let light through in part.
  [[nodiscard]] RayBatches& kind_of(std::span<const Ray> rays) const {
    const std::uint32_t bundle = rays.front().bundle;
    if (bundle == camera_bundle || all_leave_the_lens(rays)) return rays_.camera;
    return bundle == no_bundle ? rays_.bounce : rays_.shadow;
  }

  // Rays through a lens are no bundle.
  [[nodiscard]] bool all_leave_the_lens(std::span<const Ray> rays) const {
    const auto* camera = std::get_if<PerspectiveCamera>(&world_.camera);
    if (camera == nullptr || camera->aperture_radius == 0) return false;
    const double reach = 1.001 * camera->aperture_radius;
    return std::ranges::all_of(rays, [&](const Ray& ray) {
      return ray.bundle == no_bundle && glm::distance(DVec3(ray.origin), camera->position) <= reach;
    });
  }

  const World& world_;
  const Accelerator& accelerator_;
  RecordedRays& rays_;
};

// Batches drawn at random: every second or third might be of one depth of the paths.
RayBatches thinned(const RayBatches& all, std::uint64_t most, std::uint64_t seed) {
  if (all.rays.size() <= most) return all;
  std::vector<std::size_t> order(all.ends.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  std::shuffle(order.begin(), order.end(), random);
  std::size_t kept = 0;
  std::size_t rays = 0;
  while (rays < most) rays += all.batch(order[kept++]).size();
  order.resize(kept);
  std::ranges::sort(order);
  RayBatches some;
  for (const std::size_t i : order) some.add(all.batch(i));
  return some;
}

}  // namespace

void make_small(FilmSettings& film, RenderSettings& render, std::uint64_t camera_rays) {
  const double pixels = static_cast<double>(camera_rays) / samples;
  const double aspect = static_cast<double>(film.width) / film.height;
  const auto side = [](double length) {
    return static_cast<int>(std::clamp(std::round(length), 1.0, 65536.0));
  };
  film.width = side(std::sqrt(pixels * aspect));
  film.height = side(pixels / film.width);
  film.crop.reset();
  render.samples = samples;
}

RecordedRays record_rays(const World& world, const Accelerator& accelerator,
                         const FilmSettings& film, const RenderSettings& render, std::uint64_t most,
                         std::uint64_t seed) {
  RecordedRays rays;
  const Recorder recorder(world, accelerator, rays);
  RenderOptions options;
  options.threads = 1;
  (void)pah::render(world, recorder, film, render, options);
  for (RayBatches* kind : {&rays.camera, &rays.bounce, &rays.shadow})
    *kind = thinned(*kind, most, seed);
  return rays;
}

}  // namespace pah
