// The builder's heuristic for the rays of one influence area.
#pragma once

#include <pah/accel/local_bvhs.hpp>

#include "bvh/heuristic.hpp"

namespace pah {

[[nodiscard]] BuildHeuristic bundle_heuristic(const InfluenceArea& area, const LocalConfig& config);

}  // namespace pah
