// Builds the accelerator that a scene's settings ask for.
#pragma once

#include <memory>
#include <optional>
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
  std::string_view description;
};

// "bvh", "local", "light", "brute_force" and, if it was found, "embree", with descriptions.
[[nodiscard]] std::span<const AcceleratorName> accelerator_names();

// An influence area and what became of it.
struct AreaStatus {
  SceneArea area;
  AreaPlan plan;
  // If it was built: its index in LocalBvhs::reports() and uses().
  std::optional<std::size_t> built = std::nullopt;
};

struct Acceleration {
  std::string_view name;  // one of accelerator_names()
  std::unique_ptr<Accelerator> accelerator;
  std::vector<AreaStatus> areas;      // declared, then derived
  std::vector<GridPlan> grid_plans;   // for each light that is a point or has one direction
  const LocalBvhs* local = nullptr;   // the accelerator, if it has areas: those built, in order
  const LightGrids* grids = nullptr;  // the accelerator, if it has grids: those built, in order
};

// Builds an accelerator over the world's triangles; the world must outlive it. Of `settings` it
// uses influence_areas, acceleration, film and render. `name` is one of accelerator_names(). If it
// is empty, the accelerator is "local" if an area is to be built, else "light" if a pilot of a few
// thousand rays finds that a grid pays, else "bvh"; the choice of grids then depends on measured
// times. The threads of the calling arena build. All accelerators but Embree's give the same
// answers to the last bit. Throws std::invalid_argument for another name, and whatever areas_of()
// throws.
[[nodiscard]] Acceleration make_acceleration(const World& world, const Scene& settings,
                                             std::string_view name = {});

// Converts a scene's area to the form that accelerators use.
[[nodiscard]] LocalArea local_area(const SceneArea& area);

}  // namespace pah
