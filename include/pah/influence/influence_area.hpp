// Influence areas: the convex region in which a bundle of rays lives, and the bundle's projection.
//
// Every area has a right-handed frame (right, up, forward), whose forward axis is the viewing
// direction, and a picture plane with coordinates along right and up. A plane area projects onto
// the plane through its center, in units of length; a point area onto the plane at unit distance
// from its eye, in tangents. Neither needs a projection matrix with its conventions of sign and
// handedness.
#pragma once

#include <optional>
#include <pah/geometry/convex_polygon.hpp>
#include <pah/geometry/region.hpp>
#include <variant>

namespace pah {

// A bundle of parallel rays along the box's third axis, from its lower face to its upper.
struct PlaneArea {
  Obb box;
};

// The measure in which a point area's bundle is uniform: the picture plane for a camera's rays,
// solid angle for the rays of an isotropic light.
enum class PointMeasure { plane, solid_angle };

// A bundle of rays through the frustum's eye.
struct PointArea {
  Frustum frustum;
  PointMeasure measure = PointMeasure::solid_angle;
};

using InfluenceArea = std::variant<PlaneArea, PointArea>;

// `position` is the center of the face where rays start. `direction` may be any vector but 0.
// `size` and `depth` are full lengths. The rotation of the box about its direction is unspecified.
[[nodiscard]] PlaneArea make_plane_area(const DVec3& position, const DVec3& direction,
                                        const DVec2& size, double depth);

// `forward` may be any vector but 0. `fov` holds full angles in radians, in (0, pi).
[[nodiscard]] PointArea make_point_area(const DVec3& eye, const DVec3& forward, const DVec2& fov,
                                        double near, double far,
                                        PointMeasure measure = PointMeasure::solid_angle);

[[nodiscard]] Region region_of(const InfluenceArea& area);

// The unit direction of the bundle's ray through a point; the forward axis at the eye itself.
[[nodiscard]] DVec3 ray_direction(const InfluenceArea& area, const DVec3& point);

// Whether a ray runs along the bundle's ray through its origin, in either direction, up to
// `tolerance` radians. Its origin need not lie in the region.
[[nodiscard]] bool is_affine(const InfluenceArea& area, const Ray& ray, double tolerance);

// A point's place in the picture plane; nothing for a point that is not in front of the eye.
[[nodiscard]] std::optional<DVec2> project(const InfluenceArea& area, const DVec3& point);

// The area's cross-section, in the unit of its measure: length^2, tangents^2 or steradians.
[[nodiscard]] double cross_section(const InfluenceArea& area);

// The part of the cross-section whose rays meet the box within the region: all of it if the eye is
// in the box, 0 if the box does not meet the region.
[[nodiscard]] double projected_area(const PlaneArea& area, const Aabb& box);
[[nodiscard]] double projected_area(const PointArea& area, const Aabb& box);
[[nodiscard]] double projected_area(const InfluenceArea& area, const Aabb& box);

// The fraction of the bundle's rays that meet the box, in [0, 1].
[[nodiscard]] double hit_probability(const InfluenceArea& area, const Aabb& box);

// The outline, in the picture plane, of the part of the box that the rays meet within the region.
[[nodiscard]] ConvexPolygon projected_hull(const InfluenceArea& area, const Aabb& box);

}  // namespace pah
