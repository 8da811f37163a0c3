// How local BVHs are built and found.
#pragma once

#include <cstdint>
#include <pah/bvh/build_config.hpp>
#include <pah/influence/top_level.hpp>

namespace pah {

struct LocalConfig {
  Heuristic heuristic = Heuristic::surface_area;
  SplitAxis split = SplitAxis::best;
  FacingRules facing;
  // From this depth on, nodes are split by SAH along their longest axis.
  std::uint32_t non_fallback_levels = 0xFFFFFFFFU;
  BuildConfig build;
  TopLevelConfig top_level;
};

}  // namespace pah
