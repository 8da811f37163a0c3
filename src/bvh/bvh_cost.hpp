// The expected cost of tracing rays through a BVH, computed without rays.
#pragma once

#include <pah/bvh/box_measure.hpp>

#include "bvh/bvh.hpp"

namespace pah {

// The expected cost (build_config.hpp) of a ray that visits all nodes it meets, where the fraction
// measure(box) / whole of rays meets a box. Rays that hit nothing cost this, others at most this.
// All rays visit the root.
[[nodiscard]] double expected_cost(const Bvh& bvh, const BoxMeasure& measure, double whole);

}  // namespace pah
