// Grids in the space of lights over one BVH: shadow rays to a point or along a direction are looked
// up, all others traverse.
#pragma once

#include <pah/accel/accelerator.hpp>
#include <pah/geometry/exact_bundle.hpp>

namespace pah {

// Rays that name `bundle` are looked up; those that are not of it after all traverse.
struct LightBundle {
  std::uint32_t bundle = no_bundle;
  ExactBundle rays;
};

struct LightGridReport {
  std::uint64_t bytes = 0;
  double build_seconds = 0;
};

class LightGrids : public Accelerator {
 public:
  // Of each bundle, in their order.
  [[nodiscard]] virtual const std::vector<LightGridReport>& reports() const = 0;
};

// Built by the calling arena's threads.
[[nodiscard]] std::unique_ptr<LightGrids> make_light_grids(Triangles triangles,
                                                           const std::vector<LightBundle>& bundles);

}  // namespace pah
