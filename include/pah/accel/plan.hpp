// What is built for which influence area or light, and why.
#pragma once

#include <pah/accel/local_bvhs.hpp>
#include <string_view>

namespace pah {

struct AreaPlan {
  bool build = false;
  std::string_view reason;
};

// Whether an area is to have a BVH of its own.
[[nodiscard]] AreaPlan plan(const LocalArea& area);

// A light's grid (light_grids.hpp), if it is to have one.
struct GridPlan {
  std::uint32_t bundle = no_bundle;
  double expected_rays = 0;
  bool build = false;
  std::string_view reason;
};

// Whether a grid over so many triangles pays for so many rays.
[[nodiscard]] GridPlan plan_grid(std::uint32_t bundle, std::size_t triangles, double expected_rays);

}  // namespace pah
