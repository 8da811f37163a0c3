// Convex regions of space: boxes, oriented boxes and frusta.
//
// A region is a closed set. What rounding leaves undecided (some 1e-14 of the region's size) counts
// as inside, and the predicates agree about that: every triangle or box that meets the segment
// between two points which `contains` admits, or the part of a ray up to `exit_distance`, is one
// that `overlaps` admits. Nothing is ever called separate that exact arithmetic says touches.
#pragma once

#include <array>
#include <pah/geometry/aabb.hpp>
#include <pah/geometry/ray.hpp>
#include <pah/geometry/triangles.hpp>
#include <pah/geometry/vec.hpp>
#include <variant>

namespace pah {

// The points center + axes * q with |q_k| <= half_size_k.
struct Obb {
  DVec3 center{0};
  DMat3 axes{1.0};  // columns right, up, forward: orthonormal up to rounding
  DVec3 half_size{1};
};

// The points eye + axes * q with near <= q.z <= far, |q.x| <= tan_half.x q.z, |q.y| <= tan_half.y
// q.z. With near = 0 it is a pyramid with the eye as its apex.
struct Frustum {
  DVec3 eye{0};
  DMat3 axes{1.0};    // columns right, up, forward: orthonormal up to rounding
  DVec2 tan_half{1};  // tangents of half the horizontal and vertical fields of view, > 0
  double near = 0;    // 0 <= near <= far, far > 0
  double far = 1;
};

using Region = std::variant<Aabb, Obb, Frustum>;

[[nodiscard]] bool contains(const Aabb& region, const Vec3& point);  // thesis, A.6
[[nodiscard]] bool contains(const Obb& region, const Vec3& point);
// Projects the point as the thesis does (A.7), by the frustum's axes in place of a matrix.
[[nodiscard]] bool contains(const Frustum& region, const Vec3& point);
[[nodiscard]] bool contains(const Region& region, const Vec3& point);

// Whether the whole box lies in the region; an empty box lies in every one.
[[nodiscard]] bool contains(const Region& region, const Aabb& box);

// How far along a ray that starts in the region every point is still in it, rounded down; 0 if the
// ray starts outside. In units of the ray's direction; does not look at t_max.
[[nodiscard]] float exit_distance(const Region& region, const Ray& ray);

// What overlap tests need of a region. Make it once where many boxes or triangles are tested.
struct RegionShape {
  DVec3 origin{0};                  // what the vertices are relative to
  std::array<DVec3, 8> vertices{};  // corners, pushed outwards by the rounding bound
  std::array<DVec3, 6> normals{};   // directions of the faces' normals
  std::array<DVec3, 6> edges{};     // directions of the edges
  int normal_count = 0, edge_count = 0;
  Aabb box;  // encloses the vertices, rounded outwards
};
// `dilation` pushes the faces outwards by a length >= 0: by the rounding error of whatever decides
// hits, where a hit that exact arithmetic places just outside must not be lost.
[[nodiscard]] RegionShape shape_of(const Region& region, double dilation = 0);

[[nodiscard]] Aabb enclosing_box(const Region& region);

// Whether two closed boxes have a point in common; exact. An empty box has none.
[[nodiscard]] bool overlaps(const Aabb& a, const Aabb& b);
[[nodiscard]] bool overlaps(const RegionShape& region, const Aabb& box);
[[nodiscard]] bool overlaps(const RegionShape& region, const Triangle& triangle);
[[nodiscard]] bool overlaps(const Region& region, const Aabb& box);
[[nodiscard]] bool overlaps(const Region& region, const Triangle& triangle);

}  // namespace pah
