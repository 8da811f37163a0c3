// What a BVH costs rays, without rays.
#pragma once

#include <pah/bvh/box_measure.hpp>

#include "bvh/bvh.hpp"

namespace pah {

// The expected cost of traversing all that a ray meets (build_config.hpp), of rays of which those
// that meet a box are measure(box) / whole: what rays cost that hit nothing, and the most that
// others do. All rays visit the root.
[[nodiscard]] double expected_cost(const Bvh& bvh, const BoxMeasure& measure, double whole);

}  // namespace pah
