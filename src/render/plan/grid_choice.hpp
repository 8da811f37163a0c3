// Decides which lights get grids, by the cost of a few rays.
#pragma once

#include <pah/accel/light_grids.hpp>
#include <pah/accel/plan.hpp>
#include <pah/scene/scene.hpp>
#include <pah/scene/world.hpp>
#include <string_view>
#include <vector>

namespace pah {

// The reason why no light gets a grid, if that is clear without a BVH; else empty.
[[nodiscard]] std::string_view no_grids(const World& world, const Scene& settings);

// Adds the grids that pay, the best first, or all possible ones, as far as memory allows. Returns a
// plan for each light that may have a grid.
std::vector<GridPlan> add_grids(LightGrids& grids, const World& world, const Scene& settings,
                                bool all);
[[nodiscard]] std::vector<GridPlan> plans_without_grids(const World& world,
                                                        std::string_view reason);

}  // namespace pah
