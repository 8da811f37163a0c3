// From a scene's settings to what answers its rays.
#pragma once

#include <memory>
#include <pah/accel/light_grids.hpp>
#include <pah/accel/plan.hpp>
#include <pah/scene/areas.hpp>
#include <pah/scene/scene.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace pah {

struct AcceleratorName {
  std::string_view name;
  std::string_view what;
};

// "bvh", "local", "light", "brute_force" and, where it was found, "embree", and what they are.
[[nodiscard]] std::span<const AcceleratorName> accelerator_names();

struct Acceleration {
  std::string_view name;  // one of accelerator_names()
  std::unique_ptr<Accelerator> accelerator;
  std::vector<SceneArea> areas;       // declared, then derived
  std::vector<AreaPlan> plans;        // for each area
  std::vector<GridPlan> grid_plans;   // for each light that is a point or has one direction
  const LocalBvhs* local = nullptr;   // the accelerator, if it has areas: those built, in order
  const LightGrids* grids = nullptr;  // the accelerator, if it has grids: those built, in order
};

// Of `settings` it takes influence_areas, acceleration, film and render; the geometry is the
// world's, which must outlive the accelerator. `name` is one of accelerator_names(), or empty: then
// it is local if there is an area to build, light if there are lights whose grids pay, and bvh
// otherwise. Builds by the calling arena's threads. The accelerator's answers are the same to the
// last bit whatever the settings, but for Embree's. Throws std::invalid_argument for another name,
// and as areas_of does.
[[nodiscard]] Acceleration make_acceleration(const World& world, const Scene& settings,
                                             std::string_view name = {});

// A scene's area as accelerators take it.
[[nodiscard]] LocalArea local_area(const SceneArea& area);

// How acceleration settings have local BVHs built.
[[nodiscard]] LocalConfig local_config(const AccelerationSettings& settings);

}  // namespace pah
