// Sorts the shadow segments of a batch by light and resolves them together.
#include <algorithm>

#include "render/bsdf/material_eval.hpp"
#include "render/path/path_tracer.hpp"

namespace pah {

float PathTracer::opacity_at(std::uint32_t triangle, const Vec2& barycentrics,
                             float footprint) const {
  const MaterialId material = world_.surfaces[world_.surface_of_triangle[triangle]].material;
  if (masked_[material] == 0) return 1;
  return opacity(world_.materials[material], textures_, uv_at(world_, triangle, barycentrics),
                 footprint);
}

std::uint32_t PathTracer::key_of(std::uint32_t bundle) const {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(bundle) * keys_ / lights_.size());
}

// A stable counting sort by bundle, so that the segments to one light use one structure.
void PathTracer::sort_shadows(PathBatch& batch) const {
  std::fill(batch.key_ends.begin(), batch.key_ends.end(), 0);
  for (std::size_t i = 0; i < batch.shadows; ++i) {
    ++batch.key_ends[key_of(batch.shadow_rays[i].bundle)];
  }
  std::uint32_t place = 0;
  for (std::uint32_t& end : batch.key_ends) {
    const std::uint32_t size = end;
    end = place;
    place += size;
  }
  for (std::size_t i = 0; i < batch.shadows; ++i) {
    const std::uint32_t to = batch.key_ends[key_of(batch.shadow_rays[i].bundle)]++;
    batch.sorted_rays[to] = batch.shadow_rays[i];
    batch.sorted_tasks[to] = batch.shadow_tasks[i];
  }
  batch.sorted_rays.swap(batch.shadow_rays);
  batch.sorted_tasks.swap(batch.shadow_tasks);
}

void PathTracer::resolve_shadows(PathBatch& batch) const {
  if (batch.shadows == 0) return;
  if (keys_ > 1) sort_shadows(batch);
  if (any_masked_) {
    attenuate_shadows(batch);
    return;
  }
  accelerator_.occluded({batch.shadow_rays.data(), batch.shadows},
                        {batch.occluded.data(), batch.shadows}, traversal(batch, RayKind::shadow));
  batch.counts.rays[static_cast<std::size_t>(RayKind::shadow)] += batch.shadows;
  for (std::size_t i = 0; i < batch.shadows; ++i) {
    if (batch.occluded[i] == 0) {
      const ShadowTask& task = batch.shadow_tasks[i];
      batch.samples[task.slot].radiance += task.contribution;
    }
  }
}

// Used if surfaces may be partly transparent: goes from hit to hit, and each takes its share.
void PathTracer::attenuate_shadows(PathBatch& batch) const {
  for (std::uint32_t round = 0; batch.shadows > 0 && round < most_passes; ++round) {
    accelerator_.closest_hit({batch.shadow_rays.data(), batch.shadows},
                             {batch.hits.data(), batch.shadows}, traversal(batch, RayKind::shadow));
    batch.counts.rays[static_cast<std::size_t>(RayKind::shadow)] += batch.shadows;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < batch.shadows; ++i) {
      const Hit& hit = batch.hits[i];
      ShadowTask task = batch.shadow_tasks[i];
      if (!hit.valid()) {
        batch.samples[task.slot].radiance += task.contribution;
        continue;
      }
      task.contribution *= 1 - opacity_at(hit.triangle, {hit.u, hit.v}, 0);
      if (is_black(task.contribution)) continue;
      Ray ray = batch.shadow_rays[i];
      const SurfaceInteraction at = interact(world_, hit);
      if (ray.t_max < std::numeric_limits<float>::infinity()) {
        const Vec3 end = ray.origin + ray.direction;
        const float cut = (1 - ray.t_max) * glm::length(ray.direction);
        ray = spawn_segment(at.point, end, cut, ray.bundle);
      } else {
        const std::uint32_t bundle = ray.bundle;
        ray = spawn_ray(at.point, ray.direction);
        ray.bundle = bundle;
      }
      batch.shadow_rays[kept] = ray;
      batch.shadow_tasks[kept] = task;
      ++kept;
    }
    batch.shadows = kept;
  }
}

}  // namespace pah
