// Local BVHs: each influence area has one over the triangles that its rays can hit inside it. A
// global BVH serves all other rays.
#pragma once

#include <optional>
#include <pah/accel/accelerator.hpp>
#include <pah/accel/local_config.hpp>
#include <pah/influence/influence_area.hpp>
#include <vector>

namespace pah {

// An area in world coordinates, and the bundle whose rays it serves.
struct LocalArea {
  InfluenceArea area;
  std::uint32_t bundle = no_bundle;
  bool declared = false;  // in the scene file; else derived from a light or the camera
};

struct LocalBvhReport {
  std::uint64_t triangles = 0;
  std::uint64_t bytes = 0;
  double build_seconds = 0;
  // The expected costs (build_config.hpp), in the local and in the global BVH, of a ray of the
  // bundle that passes through the whole region and hits nothing; other rays cost less.
  double predicted_cost = 0;
  double global_cost = 0;
};

// The work of an area's local BVH for the rays that were traced with counts.
struct LocalBvhUse {
  std::uint64_t asked = 0;     // rays traced through the local BVH
  std::uint64_t answered = 0;  // rays of these that did not need the global BVH
  double cost = 0;             // of all rays asked, in the local BVH
  // The size of a sample of the rays asked, and its cost in the global BVH.
  std::uint64_t sampled = 0;
  double global_cost = 0;
};

class LocalBvhs : public Accelerator {
 public:
  // One report and one use for each area, in the order of the areas.
  [[nodiscard]] virtual const std::vector<LocalBvhReport>& reports() const = 0;
  [[nodiscard]] virtual std::vector<LocalBvhUse> uses() const = 0;
  // The area whose local BVH a ray is traced through first; none if that is the global BVH.
  [[nodiscard]] virtual std::optional<std::size_t> area_of(const Ray& ray) const = 0;
};

// Builds a local BVH for each area. A ray goes to the area of the least predicted cost among those
// of its bundle that hold its origin. If there is none, the top level considers all areas that hold
// its origin and whose rays run along it. Rays without an area, and rays without a final answer
// from their area, go to the global BVH.
[[nodiscard]] std::unique_ptr<LocalBvhs> make_local_bvhs(Triangles triangles,
                                                         const std::vector<LocalArea>& areas,
                                                         const LocalConfig& config = {});

}  // namespace pah
