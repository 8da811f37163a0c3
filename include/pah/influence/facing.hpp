// The splitting plane facing heuristic (SPFH): planes that rays run along split a bundle well, for
// few rays then meet both halves.
#pragma once

#include <array>
#include <pah/influence/influence_area.hpp>

namespace pah {

// How well a plane perpendicular to each axis faces rays along v, in [0, 1]: 1 - |v_k| / sum |v|.
// Large is good: 1 where rays run along the plane, 0 where they pierce it at right angles.
// (The thesis's "quality" is |v_k| / sum |v|, of which small is good.)
[[nodiscard]] DVec3 facing_quality(const DVec3& v);

// The axes, best first; equal ones in the order x, y, z.
[[nodiscard]] std::array<int, 3> facing_axis_order(const DVec3& v);

// The direction that stands for all rays through a box: of the ray through its center.
[[nodiscard]] DVec3 mean_direction(const InfluenceArea& area, const Aabb& box);

}  // namespace pah
