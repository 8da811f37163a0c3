// The report of `pahrender inspect` on a scene's BVHs and grids, for people and for tools.
#pragma once

#include <cstdint>
#include <optional>
#include <pah/bvh/analyze.hpp>
#include <pah/influence/influence_area.hpp>
#include <string>
#include <vector>

#include "report/grid_report.hpp"
#include "report/inspect/area_ray_costs.hpp"
#include "report/inspect/ray_costs.hpp"

namespace pah {

// The overlap of siblings as the bundle of an influence area sees it (pah/accel/trees.hpp).
struct SeenOverlap {
  std::vector<double> levels;  // means over the inner nodes of each
  double all = 0;              // mean over all
};
[[nodiscard]] SeenOverlap seen_overlaps(const BinaryTree& tree, const InfluenceArea& area);

// The expected costs of any ray of an influence area's bundle.
struct BundleCosts {
  double local = 0;   // in the area's own BVH
  double global = 0;  // in that of the whole scene
};

// The tree is measured by surface area, or a local BVH by the hit probability of its bundle.
struct BvhReport {
  std::string name;
  std::string heuristic;
  TreeSummary tree;                        // as built, with two children a node
  std::uint64_t wide_nodes = 0;            // as traversed, with up to eight children
  double expected_cost = 0;                // of a traversal, for a ray that meets the root's box
  double surface_cost = 0;                 // the same for rays from everywhere (SAH)
  std::optional<CostSummary> camera_rays;  // of the global BVH
  std::optional<BundleCosts> bundle;       // of a local BVH
  std::optional<AreaRayCosts> area_rays;   // of a local BVH
  std::optional<SeenOverlap> seen;         // of a local BVH
  std::uint64_t memory_bytes = 0;
  double build_seconds = 0;
};

struct InspectReport {
  std::string version;
  std::string scene;  // the name on the command line
  int width = 0, height = 0;
  std::uint64_t triangles = 0;
  std::vector<BvhReport> bvhs;
  std::string accelerator;  // of a render
  std::vector<GridReport> light_grids;
};

[[nodiscard]] std::string inspect_text(const InspectReport& report);
[[nodiscard]] std::string inspect_json(const InspectReport& report);
}  // namespace pah
