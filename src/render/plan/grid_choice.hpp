// Which lights have grids: decided by what a few rays cost.
#pragma once

#include <pah/accel/light_grids.hpp>
#include <pah/accel/plan.hpp>
#include <pah/scene/scene.hpp>
#include <pah/scene/world.hpp>
#include <string_view>
#include <vector>

namespace pah {

// Why no light is to have one, if that is clear before there is a BVH; else empty.
[[nodiscard]] std::string_view no_grids(const World& world, const Scene& settings);

// Adds the grids that pay, the best first, or all that are possible, as long as memory lasts. A
// plan for each light that may have one.
std::vector<GridPlan> add_grids(LightGrids& grids, const World& world, const Scene& settings,
                                bool all);
[[nodiscard]] std::vector<GridPlan> plans_without_grids(const World& world,
                                                        std::string_view reason);

}  // namespace pah
