// Convex regions of space: boxes, oriented boxes and frusta.
//
// A region is a closed set. Points within rounding error of its border (some 1e-14 of its size)
// count as inside, and the predicates are consistent: take a segment between two points for which
// contains() is true, or a ray up to its exit_distance(). For every triangle or box that this
// segment meets, overlaps() is true. overlaps() is never false where exact arithmetic finds that
// the two touch.
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
// Projects the point as in the thesis (A.7), but by the frustum's axes in place of a matrix.
[[nodiscard]] bool contains(const Frustum& region, const Vec3& point);
[[nodiscard]] bool contains(const Region& region, const Vec3& point);

// Whether the whole box lies in the region; an empty box lies in every one.
[[nodiscard]] bool contains(const Region& region, const Aabb& box);

// The t up to which a ray that starts in the region stays in it, rounded down; 0 if the ray starts
// outside. Ignores t_max.
[[nodiscard]] float exit_distance(const Region& region, const Ray& ray);

// A region prepared for overlap tests. Make it once to test many boxes or triangles.
struct RegionShape {
  DVec3 origin{0};                  // of the vertices' coordinates
  std::array<DVec3, 8> vertices{};  // corners, pushed outwards by the rounding bound
  std::array<DVec3, 6> normals{};   // directions of the faces' normals
  std::array<DVec3, 6> edges{};     // directions of the edges
  int normal_count = 0, edge_count = 0;
  Aabb box;  // encloses the vertices, rounded outwards
};
// `dilation` pushes the faces outwards by a length >= 0, such as the rounding error of a
// ray-triangle test, so that a hit just outside is not lost.
[[nodiscard]] RegionShape shape_of(const Region& region, double dilation = 0);

[[nodiscard]] Aabb enclosing_box(const Region& region);

// Whether two closed boxes share a point; exact. An empty box has no points.
[[nodiscard]] bool overlaps(const Aabb& a, const Aabb& b);
[[nodiscard]] bool overlaps(const RegionShape& region, const Aabb& box);
[[nodiscard]] bool overlaps(const RegionShape& region, const Triangle& triangle);
[[nodiscard]] bool overlaps(const Region& region, const Aabb& box);
[[nodiscard]] bool overlaps(const Region& region, const Triangle& triangle);

}  // namespace pah
