// The paths of a tile, which advance together, and their arrays. Each thread makes them once, so
// that nothing is allocated while rays are traced.
#pragma once

#include <pah/geometry/ray.hpp>
#include <pah/render/counts.hpp>
#include <vector>

#include "render/light/light_sampler.hpp"
#include "render/sampling/drawn_numbers.hpp"

namespace pah {

// A path through this number of masked surfaces in a row is stuck between two of them.
inline constexpr std::uint32_t most_passes = 4096;

inline bool is_black(const Vec3& color) { return color == Vec3(0); }

// A path. Its ray is in PathBatch::rays at the same index.
struct Path {
  Sampler sampler{0, 0, 0, 0};
  std::uint32_t slot = 0;  // its sample in PathBatch::samples
  std::int32_t depth = 0;  // surface interactions so far
  Vec3 throughput{1};
  float eta_scale = 1;  // undoes the scaling of radiance within glass, for roulette
  LitPoint from;        // the last scattering place, for the density of having chosen a light
  float bsdf_pdf = 0;   // of the ray's direction; 0 from the camera or a delta lobe
  float cone_width = 0, cone_spread = 0;
  float length = 0;             // of the camera ray until its first surface
  std::uint32_t passes = 0;     // through masked surfaces
  bool features_found = false;  // albedo and normal are known
};

// The result of a path.
struct PathSample {
  Vec3 radiance{0};
  Vec3 albedo{0};
  Vec3 normal{0};
  float depth = -1;  // of the first surface; < 0: none
};

// The contribution of a shadow segment if it is not occluded.
struct ShadowTask {
  Vec3 contribution{0};
  std::uint32_t slot = 0;
};

struct PathBatch {
  PathBatch(std::size_t capacity, std::size_t bundle_keys)
      : paths(capacity),
        rays(capacity),
        hits(capacity),
        samples(capacity),
        shadow_rays(capacity),
        shadow_tasks(capacity),
        sorted_rays(capacity),
        sorted_tasks(capacity),
        occluded(capacity),
        key_ends(bundle_keys) {}

  std::vector<Path> paths;
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  std::vector<PathSample> samples;
  std::size_t active = 0;

  // As gathered; below, sorted by bundle.
  std::vector<Ray> shadow_rays;
  std::vector<ShadowTask> shadow_tasks;
  std::vector<Ray> sorted_rays;
  std::vector<ShadowTask> sorted_tasks;
  std::vector<std::uint8_t> occluded;
  std::vector<std::uint32_t> key_ends;
  std::size_t shadows = 0;

  DrawnNumbers numbers;
  RenderCounts counts;
};

}  // namespace pah
