// Random rays of a bundle.
#pragma once

#include <pah/geometry/ray.hpp>
#include <pah/influence/influence_area.hpp>
#include <vector>

namespace pah {

// The points origin + t * direction, near <= t <= far: a ray within its region.
struct BundleRay {
  DVec3 origin{0};
  DVec3 direction{0, 0, 1};
  double near = 0, far = 1;
};

// Draws independent rays, uniform in the area's measure; the same for the same seed.
[[nodiscard]] std::vector<BundleRay> draw_rays(const InfluenceArea& area, std::uint64_t count,
                                               std::uint64_t seed);

// Converts it to the type that accelerators use.
[[nodiscard]] Ray ray_of(const BundleRay& ray);

}  // namespace pah
