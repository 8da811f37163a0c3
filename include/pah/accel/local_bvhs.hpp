// Influence areas at work: each has a local BVH over the triangles that can be hit inside it; a
// global BVH answers whatever no area can.
#pragma once

#include <optional>
#include <pah/accel/accelerator.hpp>
#include <pah/bvh/build_config.hpp>
#include <pah/influence/influence_area.hpp>
#include <pah/influence/top_level.hpp>
#include <vector>

namespace pah {

struct LocalConfig {
  Heuristic heuristic = Heuristic::surface_area;
  SplitAxis split = SplitAxis::best;
  FacingRules facing;
  // From this depth on nodes are built by SAH and their longest axis.
  std::uint32_t non_fallback_levels = 0xFFFFFFFFU;
  BuildConfig build;
  TopLevelConfig top_level;
};

// An area and the bundle whose rays it is for. World coordinates.
struct LocalArea {
  InfluenceArea area;
  std::uint32_t bundle = no_bundle;
  bool declared = false;  // by hand; else derived
};

struct LocalBvhReport {
  std::uint64_t triangles = 0;
  std::uint64_t bytes = 0;
  double build_seconds = 0;
  // Expected cost (build_config.hpp) in the local BVH, and in the global one, of a ray of the
  // bundle that passes through the whole region and hits nothing; others end sooner.
  double predicted_cost = 0;
  double global_cost = 0;
};

// What an area has done for rays that were traced with counts.
struct LocalBvhUse {
  std::uint64_t asked = 0;     // rays traced through its BVH
  std::uint64_t answered = 0;  // those of them that the global BVH was not asked as well
  double cost = 0;             // in its BVH, of all rays asked
  // A sample of the rays asked, and what it cost to trace them through the global BVH instead.
  std::uint64_t sampled = 0;
  double global_cost = 0;
};

class LocalBvhs : public Accelerator {
 public:
  // Both in the order of the areas.
  [[nodiscard]] virtual const std::vector<LocalBvhReport>& reports() const = 0;
  [[nodiscard]] virtual std::vector<LocalBvhUse> uses() const = 0;
  // Which of them a ray is searched for in first; none if that is the global BVH.
  [[nodiscard]] virtual std::optional<std::size_t> area_of(const Ray& ray) const = 0;
};

// Of the areas that may answer a ray the one of the least predicted cost does: of its bundle or, if
// there is none and a top level, those that hold its origin and whose rays run along it. Rays of no
// area, and those that an area cannot answer for certain, go to the global BVH.
[[nodiscard]] std::unique_ptr<LocalBvhs> make_local_bvhs(Triangles triangles,
                                                         const std::vector<LocalArea>& areas,
                                                         const LocalConfig& config = {});

}  // namespace pah
