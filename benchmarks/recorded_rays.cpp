#include "recorded_rays.hpp"

#include <algorithm>
#include <pah/render/render.hpp>

namespace pah::bench {
namespace {

// Stands between the renderer and a BVH. For one thread.
class Recorder final : public Accelerator {
 public:
  Recorder(const World& world, RecordedRays& rays)
      : bvh_(make_global_bvh(world.triangles())), rays_(rays) {}

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    keep(rays, rays.front().bundle == camera_bundle ? rays_.camera : rays_.bounce);
    bvh_->closest_hit(rays, hits, counts);
  }

  // They come grouped by light.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    const auto first_to_sun = std::ranges::find(rays, MeshScene::sun, &Ray::bundle);
    const auto to_bulb = static_cast<std::size_t>(first_to_sun - rays.begin());
    keep(rays.first(to_bulb), rays_.to_bulb);
    keep(rays.subspan(to_bulb), rays_.to_sun);
    bvh_->occluded(rays, results, counts);
  }

  [[nodiscard]] AcceleratorMemory memory() const override { return bvh_->memory(); }

 private:
  static void keep(std::span<const Ray> rays, RayBatches& batches) {
    if (!rays.empty()) batches.emplace_back(rays.begin(), rays.end());
  }

  std::unique_ptr<Accelerator> bvh_;
  RecordedRays& rays_;
};

}  // namespace

RecordedRays record_rays(const MeshScene& scene) {
  RecordedRays rays;
  const Recorder recorder(scene.world, rays);
  RenderOptions options;
  options.threads = 1;
  (void)render(scene.world, recorder, scene.film, scene.render, options);
  return rays;
}

}  // namespace pah::bench
