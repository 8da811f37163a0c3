// The separating axis test between a convex region and a box or triangle.
//
// Two convex polyhedra are separate if and only if their projections on some axis are: on a face
// normal of either, or on the cross product of two edges (thesis, A.5). An axis may be badly
// rounded, or even zero, as the cross product of parallel edges is. Whatever the axis, a gap wider
// than the rounding error of the projections proves separation; a bad axis shows no gap.
#include <algorithm>
#include <cmath>
#include <pah/geometry/region.hpp>
#include <span>

#include "geometry/rounding.hpp"

namespace pah {

namespace {

double largest_coordinate(std::span<const DVec3> points) {
  double largest = 0;
  for (const DVec3& p : points)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

class SeparatingAxisTest {
 public:
  // Points are relative to the region's origin; those of `other` were rounded once for that.
  SeparatingAxisTest(std::span<const DVec3> region, std::span<const DVec3> other)
      : region_(region),
        other_(other),
        reach_(std::max(largest_coordinate(region), largest_coordinate(other))) {}

  [[nodiscard]] bool separated_along(const DVec3& axis) const {
    const Interval a = project(region_, axis);
    const Interval b = project(other_, axis);
    // Each dot product has an error of at most 3 unit roundoffs of |axis|_1 * reach; the rounded
    // difference adds one. Both sides make 8, doubled for safety.
    const double axis_length = std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z);
    const double margin = 16 * double_unit_roundoff * axis_length * reach_;
    return a.low - b.high > margin || b.low - a.high > margin;
  }

 private:
  struct Interval {
    double low, high;
  };
  static Interval project(std::span<const DVec3> points, const DVec3& axis) {
    Interval result{glm::dot(points[0], axis), glm::dot(points[0], axis)};
    for (const DVec3& p : points.subspan(1)) {
      const double x = glm::dot(p, axis);
      result.low = std::min(result.low, x);
      result.high = std::max(result.high, x);
    }
    return result;
  }

  std::span<const DVec3> region_, other_;
  double reach_;
};

bool separated(const RegionShape& region, std::span<const DVec3> other,
               std::span<const DVec3> other_normals, std::span<const DVec3> other_edges) {
  const SeparatingAxisTest test(region.vertices, other);
  const auto separates = [&](const DVec3& axis) { return test.separated_along(axis); };
  const std::span normals(region.normals.data(), static_cast<std::size_t>(region.normal_count));
  const std::span edges(region.edges.data(), static_cast<std::size_t>(region.edge_count));
  if (std::any_of(normals.begin(), normals.end(), separates)) return true;
  if (std::any_of(other_normals.begin(), other_normals.end(), separates)) return true;
  for (const DVec3& a : edges)
    for (const DVec3& b : other_edges)
      if (separates(glm::cross(a, b))) return true;
  return false;
}

}  // namespace

bool overlaps(const Aabb& a, const Aabb& b) {
  return !a.empty() && !b.empty() && a.min.x <= b.max.x && b.min.x <= a.max.x &&
         a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z && b.min.z <= a.max.z;
}

bool overlaps(const RegionShape& region, const Aabb& box) {
  if (!overlaps(region.box, box)) return false;
  std::array<DVec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i) corners[i] = DVec3(box.corner(i)) - region.origin;
  constexpr std::array edges{DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)};
  return !separated(region, corners, edges, edges);
}

bool overlaps(const RegionShape& region, const Triangle& triangle) {
  if (!overlaps(region.box, triangle.bounds())) return false;
  const std::array corners{DVec3(triangle.a) - region.origin, DVec3(triangle.b) - region.origin,
                           DVec3(triangle.c) - region.origin};
  const std::array edges{DVec3(triangle.b) - DVec3(triangle.a),
                         DVec3(triangle.c) - DVec3(triangle.b),
                         DVec3(triangle.a) - DVec3(triangle.c)};
  const std::array normal{glm::cross(edges[0], edges[1])};
  return !separated(region, corners, normal, edges);
}

bool overlaps(const Region& region, const Aabb& box) {
  if (const auto* aabb = std::get_if<Aabb>(&region)) return overlaps(*aabb, box);
  return overlaps(shape_of(region), box);
}

bool overlaps(const Region& region, const Triangle& triangle) {
  return overlaps(shape_of(region), triangle);
}

}  // namespace pah
