// What the local BVHs of influence areas cost real rays: those that a camera and lights ask first.
#pragma once

#include <pah/accel/local_bvhs.hpp>
#include <pah/scene/settings.hpp>
#include <pah/scene/world.hpp>
#include <vector>

#include "bvh/bvh.hpp"

namespace pah {

struct AreaRayCosts {
  std::uint64_t rays = 0;      // that are searched for in the area's BVH first
  std::uint64_t answered = 0;  // of these: without the global BVH
  double local = 0;   // a ray: in the area's BVH, and in the global one where that is asked
  double global = 0;  // a ray: the same ones in the global BVH alone
};

// Of one ray a pixel to each light that shines on what the pixel's central ray meets, and of that
// central ray if the camera has an area; each goes to the area that answers it in a render with
// these areas. In the order of the areas, of which all are built. Costs are traversal_cost().
[[nodiscard]] std::vector<AreaRayCosts> measure_area_costs(const World& world, const Bvh& global,
                                                           const std::vector<LocalArea>& areas,
                                                           const LocalConfig& config,
                                                           const FilmSettings& film);

}  // namespace pah
