#include "rays/recorded_rays.hpp"

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
    for (auto left = rays; !left.empty();) {
      const LightId light = left.front().bundle;
      const auto end =
          std::ranges::find_if(left, [&](const Ray& ray) { return ray.bundle != light; });
      const auto size = static_cast<std::size_t>(end - left.begin());
      keep(left.first(size), to_light(light));
      left = left.subspan(size);
    }
    bvh_->occluded(rays, results, counts);
  }

  [[nodiscard]] AcceleratorMemory memory() const override { return bvh_->memory(); }

 private:
  [[nodiscard]] RayBatches& to_light(LightId light) const {
    if (light == MeshScene::bulb) return rays_.to_bulb;
    return light == MeshScene::sun ? rays_.to_sun : rays_.to_spot;
  }

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
