#include "rays/subjects.hpp"

#include <chrono>
#include <pah/accel/light_grids.hpp>

#include "generated_scenes.hpp"
#include "rays/sorted_rays.hpp"

namespace pah::bench {
namespace {

std::unique_ptr<Accelerator> make_bvh(const MeshScene& scene) {
  return make_global_bvh(scene.world.triangles());
}

std::unique_ptr<Accelerator> make_grids(const MeshScene& scene) {
  std::vector<LightBundle> bundles;
  for (const LightId light : {MeshScene::bulb, MeshScene::sun, MeshScene::spot})
    bundles.push_back({light, *exact_bundle(scene.world.lights[light])});
  return make_light_grids(scene.world.triangles(), bundles);
}

std::unique_ptr<Accelerator> make_local(const MeshScene& scene) {
  LocalConfig config;
  config.heuristic = Heuristic::projected_area;
  config.split = SplitAxis::longest;
  return make_local_bvhs(scene.world.triangles(), scene.areas, config);
}

template <EmbreeRays rays>
std::unique_ptr<Accelerator> make_peer(const MeshScene& scene) {
  return make_embree(scene.world.triangles(), EmbreeQuality::high, rays);
}

template <EmbreeRays rays>
std::unique_ptr<Accelerator> make_sorted_peer(const MeshScene& scene) {
  return make_sorted(make_peer<rays>(scene));
}

using Make = std::unique_ptr<Accelerator> (*)(const MeshScene&);

const std::map<std::string, Make> makers{
    {"bvh", make_bvh},
    {"light_grid", make_grids},
    {"local_pah", make_local},
    {"embree", make_peer<EmbreeRays::single>},
    {"embree_packet8", make_peer<EmbreeRays::packets_of_8>},
    {"embree_packet16", make_peer<EmbreeRays::packets_of_16>},
    {"embree_sorted", make_sorted_peer<EmbreeRays::single>},
    {"embree_sorted_packet16", make_sorted_peer<EmbreeRays::packets_of_16>},
};

}  // namespace

const BuiltAccelerator& Subject::built(const std::string& accelerator) {
  BuiltAccelerator& built = built_[accelerator];
  if (built.accelerator == nullptr) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    built.accelerator = makers.at(accelerator)(scene_);
    built.build_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return built;
}

Subject& subject(const std::string& mesh) {
  static std::map<std::string, Subject> kept;
  const bool large = is_generated(mesh);
  if (large && !kept.contains(mesh))
    std::erase_if(kept, [](const auto& other) { return is_generated(other.first); });
  return kept.try_emplace(mesh, mesh).first->second;
}

}  // namespace pah::bench
