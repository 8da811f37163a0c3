// Light grids over one BVH. Shadow rays to a point or along a direction are looked up in their
// light's grid; all other rays traverse the BVH.
#pragma once

#include <pah/accel/accelerator.hpp>
#include <pah/geometry/exact_bundle.hpp>

namespace pah {

// A light's bundle. Rays that name `bundle` are looked up; those that do not belong to `rays`
// traverse.
struct LightBundle {
  std::uint32_t bundle = no_bundle;
  ExactBundle rays;
};

// Statistics of a grid's cells, each of which lists blocks of triangles.
struct GridLists {
  std::uint64_t cells = 0;
  std::uint64_t empty_cells = 0;
  std::uint64_t entries = 0;  // the sum over all lists
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
  // Adds a grid, built by the calling arena's threads, or removes one. Not while rays are traced.
  virtual void add(const LightBundle& bundle) = 0;
  virtual void remove(std::uint32_t bundle) = 0;

  // One report for each bundle with a grid, in ascending order.
  [[nodiscard]] virtual std::vector<LightGridReport> reports() const = 0;
  [[nodiscard]] virtual double bvh_build_seconds() const = 0;
};

// The calling arena's threads build the BVH and the grids.
[[nodiscard]] std::unique_ptr<LightGrids> make_light_grids(
    Triangles triangles, const std::vector<LightBundle>& bundles = {});

}  // namespace pah
