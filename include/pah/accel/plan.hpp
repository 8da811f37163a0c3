// What is built for which influence area or light, and why.
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

// Whether an area is to have a BVH of its own.
[[nodiscard]] AreaPlan plan(const LocalArea& area);

// What a few rays to a light told before it had a grid.
struct GridPilot {
  double expected_rays = 0;  // in the whole render
  std::size_t rays = 0;      // that were traced
  double occluded_share = 0;
  double seconds = 0;  // a ray, of one thread, in the BVH
  double cost = 0;     // the same by the model of build_config.hpp
};

struct GridCircumstances {
  std::size_t triangles = 0;
  double bvh_build_seconds = 0;
  int threads = 1;
  std::uint64_t memory_left = UINT64_MAX;  // bytes
};

// A light's grid (light_grids.hpp), if it is to have one. All seconds a ray are those of a thread.
struct GridPlan {
  std::uint32_t bundle = no_bundle;
  bool build = false;
  std::string_view reason;
  std::optional<GridPilot> pilot;  // none where the answer was clear without
  double predicted_seconds = 0;    // a ray
  double predicted_build_seconds = 0;
  std::uint64_t predicted_bytes = 0;
  double predicted_saving = 0;             // seconds of the whole render, its build included
  std::optional<double> measured_seconds;  // a ray of the pilot, in the grid
  std::optional<double> measured_saving;   // with that and the time that the build took
};

// Whether a grid pays.
[[nodiscard]] GridPlan plan_grid(std::uint32_t bundle, const ExactBundle& rays,
                                 const GridPilot& pilot, const GridCircumstances& at);

// The same once it is there: whether it stays.
void measure_grid(GridPlan& plan, double seconds_a_ray, double build_seconds, std::uint64_t bytes,
                  const GridCircumstances& at);

}  // namespace pah
