// The splitting plane facing heuristic (SPFH). A plane along which rays run splits a bundle well:
// few rays meet both halves.
#pragma once

#include <array>
#include <pah/influence/influence_area.hpp>

namespace pah {

// How well a plane perpendicular to each axis faces rays along v, in [0, 1]: 1 - |v_k| / sum |v|.
// It is 1 where rays run along the plane and 0 where they pierce it at right angles. (The thesis's
// "quality" is |v_k| / sum |v|, of which less is better.)
[[nodiscard]] DVec3 facing_quality(const DVec3& v);

// The axes, best first; equal ones in the order x, y, z.
[[nodiscard]] std::array<int, 3> facing_axis_order(const DVec3& v);

// The direction of the ray through the box's center, which stands for all rays through the box.
[[nodiscard]] DVec3 mean_direction(const InfluenceArea& area, const Aabb& box);

}  // namespace pah
