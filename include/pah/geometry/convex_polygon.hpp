// Convex polygons in the plane.
//
// Orientation tests are exact, so that collinear points and touching or identical polygons need no
// tolerance. Coordinates must be finite, and products of two of them within double's range.
#pragma once

#include <pah/geometry/vec.hpp>
#include <span>
#include <vector>

namespace pah {

// The vertices of a convex polygon, counter-clockwise. Repeated and collinear vertices are allowed;
// fewer than three make a polygon without area.
using ConvexPolygon = std::vector<DVec2>;

// The sign of the turn a -> b -> c: 1 left, 0 straight, -1 right. Exact.
[[nodiscard]] int orientation(const DVec2& a, const DVec2& b, const DVec2& c);

// The smallest convex polygon around the points, without repeated or collinear vertices.
[[nodiscard]] ConvexPolygon convex_hull(std::span<const DVec2> points);

// The area, by the shoelace formula (thesis, A.10) relative to the first vertex: large coordinates
// do not cancel.
[[nodiscard]] double area(std::span<const DVec2> polygon);

// Whether the point lies in the polygon or on its boundary (thesis, A.8). Exact.
[[nodiscard]] bool contains(std::span<const DVec2> polygon, const DVec2& point);

// The common part of two polygons (thesis, A.9). Its vertices are rounded once each.
[[nodiscard]] ConvexPolygon intersection(const ConvexPolygon& a, const ConvexPolygon& b);

// The area of the common part: symmetric, and never above the area of either.
[[nodiscard]] double overlap_area(const ConvexPolygon& a, const ConvexPolygon& b);

}  // namespace pah
