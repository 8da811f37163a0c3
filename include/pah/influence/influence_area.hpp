// Influence areas: the convex region in which a bundle of rays lives, and how the bundle sees it.
//
// Every area has a right-handed frame (right, up, forward), forward being the way the rays are
// looked along, and a picture plane with coordinates along right and up. A plane area projects onto
// the plane through its center, in units of length; a point area onto the plane at unit distance
// from its eye, in tangents. No matrix with its signs and handedness is needed for either.
#pragma once

#include <optional>
#include <pah/geometry/convex_polygon.hpp>
#include <pah/geometry/region.hpp>
#include <variant>

namespace pah {

// Parallel rays along the box's third axis, from its lower face to its upper.
struct PlaneArea {
  Obb box;
};

// What a point area's bundle is uniform in: the picture plane, as a camera's rays are, or solid
// angle, as the rays of an isotropic light are.
enum class PointMeasure { plane, solid_angle };

// Rays through the frustum's eye.
struct PointArea {
  Frustum frustum;
  PointMeasure measure = PointMeasure::solid_angle;
};

using InfluenceArea = std::variant<PlaneArea, PointArea>;

// `position` is the center of the face where rays start, `direction` any vector but 0; `size` and
// `depth` are whole lengths. How the box is turned about its direction is unspecified.
[[nodiscard]] PlaneArea make_plane_area(const DVec3& position, const DVec3& direction,
                                        const DVec2& size, double depth);

// `forward` is any vector but 0, `fov` full angles in radians, in (0, pi).
[[nodiscard]] PointArea make_point_area(const DVec3& eye, const DVec3& forward, const DVec2& fov,
                                        double near, double far,
                                        PointMeasure measure = PointMeasure::solid_angle);

[[nodiscard]] Region region_of(const InfluenceArea& area);

// The unit direction of the bundle's ray through a point; the forward axis at the eye itself.
[[nodiscard]] DVec3 ray_direction(const InfluenceArea& area, const DVec3& point);

// Whether a ray runs along the bundle's ray through its origin, either way, up to `tolerance`
// radians. Whether its origin lies in the region is another question.
[[nodiscard]] bool is_affine(const InfluenceArea& area, const Ray& ray, double tolerance);

// Where a point appears in the picture plane; nothing for points that are not before the eye.
[[nodiscard]] std::optional<DVec2> project(const InfluenceArea& area, const DVec3& point);

// The area's cross-section, in the unit of its measure: length^2, tangents^2 or steradians.
[[nodiscard]] double cross_section(const InfluenceArea& area);

// The part of the cross-section whose rays meet the box within the region. All of it if the eye is
// in the box, 0 if the box does not meet the region.
[[nodiscard]] double projected_area(const PlaneArea& area, const Aabb& box);
[[nodiscard]] double projected_area(const PointArea& area, const Aabb& box);
[[nodiscard]] double projected_area(const InfluenceArea& area, const Aabb& box);

// The share of the bundle's rays that meet the box, in [0, 1].
[[nodiscard]] double hit_probability(const InfluenceArea& area, const Aabb& box);

// The outline in the picture plane of what the rays meet of the box within the region.
[[nodiscard]] ConvexPolygon projected_hull(const InfluenceArea& area, const Aabb& box);

}  // namespace pah
