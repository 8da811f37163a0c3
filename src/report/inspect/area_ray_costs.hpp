// Measures what the rays of a picture cost in local BVHs.
#pragma once

#include <pah/accel/local_bvhs.hpp>
#include <pah/scene/settings.hpp>
#include <pah/scene/world.hpp>
#include <vector>

#include "bvh/bvh.hpp"

namespace pah {

struct AreaRayCosts {
  std::uint64_t rays = 0;      // traced in the area's BVH first
  std::uint64_t answered = 0;  // of these, answered without the global BVH
  double local = 0;   // per ray: in the area's BVH, and in the global one if that is needed
  double global = 0;  // per ray: in the global BVH alone
};

// Traces, for each pixel, a ray from the point that its central ray meets to each light that shines
// on it, and the central ray itself if the camera has an area. Each ray goes to the area that
// answers it in a render with these areas, all of which are built. Returns the costs
// (traversal_cost()) in the order of the areas.
[[nodiscard]] std::vector<AreaRayCosts> measure_area_costs(const World& world, const Bvh& global,
                                                           const std::vector<LocalArea>& areas,
                                                           const LocalConfig& config,
                                                           const FilmSettings& film);

}  // namespace pah
