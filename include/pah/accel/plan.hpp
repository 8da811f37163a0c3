// Decides which influence areas get a local BVH and which lights get a grid, and gives the reasons.
#pragma once

#include <cstdint>
#include <optional>
#include <pah/accel/local_bvhs.hpp>
#include <pah/geometry/exact_bundle.hpp>
#include <string_view>

namespace pah {

struct AreaPlan {
  bool build = false;
  std::string_view reason;
};

// Decides whether to build a local BVH for an area.
[[nodiscard]] AreaPlan plan(const LocalArea& area);

// Measurements of a few rays to a light, traced before it has a grid.
struct GridPilot {
  double expected_rays = 0;  // in the whole render
  std::size_t rays = 0;      // in the pilot
  double occluded_share = 0;
  double seconds = 0;  // per ray of one thread in the BVH
  double cost = 0;     // per ray, by the model of build_config.hpp
};

// The facts about the scene and the machine on which a plan depends.
struct GridCircumstances {
  std::size_t triangles = 0;
  double bvh_build_seconds = 0;
  int threads = 1;
  std::uint64_t memory_left = UINT64_MAX;  // bytes
};

// The decision about a light's grid (light_grids.hpp). Seconds per ray are those of one thread.
struct GridPlan {
  std::uint32_t bundle = no_bundle;
  bool build = false;
  std::string_view reason;
  std::optional<GridPilot> pilot;  // none if the decision did not need one
  double predicted_seconds = 0;    // per ray
  double predicted_build_seconds = 0;
  std::uint64_t predicted_bytes = 0;
  double predicted_saving = 0;             // seconds of the whole render, less the build
  std::optional<double> measured_seconds;  // per ray of the pilot in the grid
  std::optional<double> measured_saving;   // from the measured times of rays and build
};

// Predicts whether a grid saves time, and decides whether to build it.
[[nodiscard]] GridPlan plan_grid(std::uint32_t bundle, const ExactBundle& rays,
                                 const GridPilot& pilot, const GridCircumstances& at);

// Decides from measurements whether a grid that was built is kept.
void measure_grid(GridPlan& plan, double seconds_per_ray, double build_seconds, std::uint64_t bytes,
                  const GridCircumstances& at);

}  // namespace pah
