// Measures what camera rays cost in a BVH: one through the center of every pixel.
#pragma once

#include <cstdint>
#include <pah/scene/camera.hpp>
#include <pah/scene/settings.hpp>
#include <vector>

#include "bvh/bvh.hpp"

namespace pah {

struct RayCost {
  std::uint32_t nodes = 0;      // eight-wide inner nodes and leaves visited
  std::uint32_t triangles = 0;  // tested
  bool hit = false;
};

struct PictureCosts {
  int width = 0, height = 0;
  std::vector<RayCost> rays;  // rows from the top
};

struct CostSummary {
  std::uint64_t rays = 0, hits = 0;
  double nodes_per_ray = 0, triangles_per_ray = 0;
  std::uint32_t max_nodes = 0, max_triangles = 0;  // of one ray
};

// Measures the whole picture, without a crop.
[[nodiscard]] PictureCosts measure_costs(const Bvh& bvh, const Camera& camera,
                                         const FilmSettings& film);

[[nodiscard]] CostSummary summarize(const PictureCosts& costs);

}  // namespace pah
