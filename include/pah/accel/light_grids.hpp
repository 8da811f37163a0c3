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

// The cells of a grid, each with its list of blocks of triangles.
struct GridLists {
  std::uint64_t cells = 0;
  std::uint64_t empty_cells = 0;
  std::uint64_t entries = 0;  // of all lists
  std::uint64_t longest_list = 0;
};

struct LightGridReport {
  std::uint32_t bundle = no_bundle;
  std::uint64_t bytes = 0;
  double build_seconds = 0;
  GridLists lists;
};

class LightGrids : public Accelerator {
 public:
  // Builds one more, by the calling arena's threads, or drops one. Not while rays are asked.
  virtual void add(const LightBundle& bundle) = 0;
  virtual void remove(std::uint32_t bundle) = 0;

  // Of each bundle that has a grid, ascending.
  [[nodiscard]] virtual std::vector<LightGridReport> reports() const = 0;
  [[nodiscard]] virtual double bvh_build_seconds() const = 0;
};

// Built by the calling arena's threads.
[[nodiscard]] std::unique_ptr<LightGrids> make_light_grids(
    Triangles triangles, const std::vector<LightBundle>& bundles = {});

}  // namespace pah
