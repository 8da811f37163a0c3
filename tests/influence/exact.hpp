// The reference for projections and overlaps, in exact rational arithmetic, by CGAL where it has
// the operation. Only exact.cpp includes CGAL.
#pragma once

#include <pah/influence/box_sectors.hpp>
#include <pah/influence/influence_area.hpp>

namespace exact_answer {

// Whether the corners, in this order, are the counter-clockwise convex hull of the whole box as the
// area projects it. Every corner must be in front of the eye. Collinear corners are allowed.
bool is_projected_hull(const pah::InfluenceArea& area, const pah::Aabb& box,
                       std::span<const std::uint8_t> corners);

// The exact projected_area(): the measure of the projection of the box's part in the region.
double projected_area(const pah::InfluenceArea& area, const pah::Aabb& box);

bool contains(const pah::Region& region, const pah::Vec3& point);
bool contains(const pah::ConvexPolygon& polygon, const pah::DVec2& point);  // a simple polygon
bool overlaps(const pah::Region& region, const pah::Aabb& box);
bool overlaps(const pah::Region& region, const pah::Triangle& triangle);

pah::ConvexPolygon convex_hull(std::span<const pah::DVec2> points);
double area(const pah::ConvexPolygon& polygon);

// Polygons without area or with repeated vertices are cleaned first: CGAL takes simple ones only.
double overlap_area(const pah::ConvexPolygon& a, const pah::ConvexPolygon& b);

}  // namespace exact_answer
