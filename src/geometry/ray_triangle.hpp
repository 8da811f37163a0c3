// The ray-triangle rule that all accelerators share to the last bit.
//
// A ray hits a triangle if and only if
//   1. the watertight test of Woop, Benthin and Wald ("Watertight Ray/Triangle Intersection", JCGT
//      2013) accepts: the ray's line meets the triangle, edges and vertices included, both faces;
//   2. the hit is certainly in front of the origin: all three vertices are, or t exceeds its error
//      bound (pbrt-v4, 6.8.5 "Robust Triangle Intersections");
//   3. t is at most t_max.
// The hit of the least (t, triangle index) wins.
//
// Why no accelerator changes an answer. The rule depends on the ray and the triangle alone, and its
// t lies in the interval of every box around the triangle or around the part of it that is hit
// (ray_box.hpp). So a traversal that skips a node only if the node's interval is empty or starts
// beyond a hit already found cannot skip the winner, whatever the tree and the order.
//
// Why origin + t d lies within 30 u M of a point of the triangle. Let u be the unit roundoff and M
// the largest distance along an axis from the origin to a vertex.
// - The test rounds vertices: with |shear| <= 1, x - shear * z has an error of u M (x) + 4 u M
//   (shear * z, where shear is a product with a reciprocal) + 2 u M (difference) = 7 u M. The edge
//   functions of these rounded vertices have the exact sign: rounding is monotone, so a float
//   difference of float products has a wrong sign only if it is zero, and then doubles decide
//   (products of floats are exact in double). So the line meets the triangle of the rounded
//   vertices, at weights that make a point of the true triangle at most 7 u M away.
// - t is the weighted sum of depths. Its terms have at most 9 roundings (two of the depth, sum of
// edge
//   functions, inverse, product, product, sum): 9 u Z, where Z is the largest depth.
// - The edge functions are exact in double. In float each has an error of at most 2 u X Y and u of
//   itself, where X and Y are the largest |x| and |y|. As t = sum of e z / sum of e, this moves t
//   by 6 u X Y R / |determinant| + u R, where R is the range of depths. Where X Y R > 2 Z
//   |determinant|, doubles take over; else this is at most 12 u Z + 2 u Z.
// Together: 7 u M + 23 u M.
//
// Two triangles with a shared edge compute its edge function with opposite signs and the same
// digits: there is no crack.
#pragma once

#include <algorithm>
#include <cmath>
#include <pah/geometry/triangles.hpp>

#include "geometry/ray_box.hpp"

namespace pah {

// All functions are inlined: kernels are compiled for several instruction sets, and a call from one
// to code of another costs more than the function itself.

struct TriangleHit {
  float t = 0;
  float u = 0;
  float v = 0;
};

namespace detail {

// A vertex in the coordinates in which the ray is the z axis.
struct ShearedVertex {
  float x, y, z;
  float t;  // z in units of the ray's direction
};

[[nodiscard, gnu::always_inline]] inline ShearedVertex shear(const PreparedRay& ray,
                                                             const Vec3& vertex) {
  const float* const along = &vertex.x;
  const auto z = static_cast<std::size_t>(ray.z_axis);
  const std::size_t x = next_axis[z];
  const std::size_t y = next_axis[x];
  const float depth = along[z] - ray.origin[2];
  return {(along[x] - ray.origin[0]) - ray.shear_x * depth,
          (along[y] - ray.origin[1]) - ray.shear_y * depth, depth, depth * ray.scale_z};
}

// The edge functions: twice the signed areas of the triangles that the origin makes with the edges
// opposite to vertices a, b and c.
template <typename Real>
struct EdgeFunctions {
  Real a, b, c;

  [[gnu::always_inline]] EdgeFunctions(const ShearedVertex& p, const ShearedVertex& q,
                                       const ShearedVertex& r)
      : a(cross(r, q)), b(cross(p, r)), c(cross(q, p)) {}

  [[nodiscard, gnu::always_inline]] bool mixed_signs() const {
    return (a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0);
  }
  [[nodiscard, gnu::always_inline]] Real determinant() const { return a + b + c; }

 private:
  [[gnu::always_inline]] static Real cross(const ShearedVertex& p, const ShearedVertex& q) {
    return Real{p.x} * Real{q.y} - Real{p.y} * Real{q.x};
  }
};

[[nodiscard, gnu::always_inline]] inline float largest_size(float a, float b, float c) {
  return std::max(std::abs(a), std::max(std::abs(b), std::abs(c)));
}

// The extent of the vertices across the ray and along it.
struct Extent {
  float x, y, z;            // largest absolute values
  float nearest, farthest;  // t
  float depth;              // largest |t|

  [[gnu::always_inline]] Extent(const ShearedVertex& p, const ShearedVertex& q,
                                const ShearedVertex& r)
      : x(largest_size(p.x, q.x, r.x)),
        y(largest_size(p.y, q.y, r.y)),
        z(largest_size(p.z, q.z, r.z)),
        nearest(std::min(p.t, std::min(q.t, r.t))),
        farthest(std::max(p.t, std::max(q.t, r.t))),
        depth(std::max(std::abs(nearest), std::abs(farthest))) {}
};

// The range of determinants in which float neither overflows nor underflows.
inline constexpr float least_determinant = 0x1p-100F;
inline constexpr float most_determinant = 0x1p100F;

// Whether float is accurate enough for t: see the top of this file.
[[nodiscard, gnu::always_inline]] inline bool well_conditioned(const EdgeFunctions<float>& edge,
                                                               const Extent& extent) {
  if (edge.a == 0 || edge.b == 0 || edge.c == 0) return false;
  const float size = std::abs(edge.determinant());
  if (!(size >= least_determinant && size <= most_determinant)) return false;
  return extent.x * (1 / size) * extent.y * (extent.farthest - extent.nearest) <= 2 * extent.depth;
}

// A bound on the error of t (pbrt-v4, 6.8.5), which decides whether t is certainly positive. Depths
// take 5 roundings, their weighted sum 7.
template <typename Real>
[[nodiscard, gnu::always_inline]] inline Real distance_error(const EdgeFunctions<Real>& edge,
                                                             const Extent& extent) {
  const float error_x = rounding_bound(5) * (extent.x + extent.z);
  const float error_y = rounding_bound(5) * (extent.y + extent.z);
  const float error_edge =
      2 * (rounding_bound(2) * extent.x * extent.y + (error_y * extent.x + error_x * extent.y));
  const Real largest = std::max(std::abs(edge.a), std::max(std::abs(edge.b), std::abs(edge.c)));
  const Real error = Real{rounding_bound(12)} * largest + Real{error_edge};
  return 3 * error * (1 / std::abs(edge.determinant())) * Real{extent.depth};
}

// Parts 2 and 3 of the rule, given that the ray's line meets the triangle.
template <typename Real>
[[nodiscard, gnu::always_inline]] inline bool hit_in_front(
    const EdgeFunctions<Real>& edge, const Extent& extent, const ShearedVertex& p,
    const ShearedVertex& q, const ShearedVertex& r, float t_limit, TriangleHit& hit) {
  const Real determinant = edge.determinant();
  if (!(std::abs(determinant) > 0)) return false;  // the ray lies in the triangle's plane
  const Real inverse = 1 / determinant;
  const auto weight = [&](Real e) __attribute__((always_inline)) {
    return static_cast<float>(std::min(e * inverse, Real{1}));
  };
  const float a = weight(edge.a);
  const float b = weight(edge.b);
  const float c = weight(edge.c);
  const float t = a * p.t + b * q.t + c * r.t;
  hit = {t, b, c};
  return t > 0 && t <= t_limit && (extent.nearest > 0 || Real{t} > distance_error(edge, extent));
}

}  // namespace detail

// Whether the ray hits the triangle at a t of at most `t_limit`; if not, `hit` is unspecified. The
// caller resolves ties.
[[nodiscard, gnu::always_inline]] inline bool intersect_triangle(const PreparedRay& ray,
                                                                 const Triangle& triangle,
                                                                 float t_limit, TriangleHit& hit) {
  const detail::ShearedVertex p = detail::shear(ray, triangle.a);
  const detail::ShearedVertex q = detail::shear(ray, triangle.b);
  const detail::ShearedVertex r = detail::shear(ray, triangle.c);
  const detail::EdgeFunctions<float> edge(p, q, r);
  if (edge.mixed_signs()) return false;

  const detail::Extent extent(p, q, r);
  if (detail::well_conditioned(edge, extent))
    return detail::hit_in_front(edge, extent, p, q, r, t_limit, hit);
  const detail::EdgeFunctions<double> exact(p, q, r);
  return !exact.mixed_signs() && detail::hit_in_front(exact, extent, p, q, r, t_limit, hit);
}

// A search starts with nothing_yet(t_max), which has no triangle. finished() turns it into an
// invalid hit at infinity if none was found.
[[nodiscard, gnu::always_inline]] inline Hit nothing_yet(float t_max) {
  Hit hit;
  hit.t = t_max;
  return hit;
}
[[nodiscard, gnu::always_inline]] inline Hit finished(const Hit& hit) {
  return hit.valid() ? hit : Hit{};
}

// Updates `best` with a hit of no larger t. Of equal t, the lower index wins.
[[gnu::always_inline]] inline void keep_nearer(const TriangleHit& hit, std::uint32_t index,
                                               Hit& best) {
  if (hit.t < best.t || index < best.triangle) best = {hit.t, hit.u, hit.v, index};
}

// Tests a triangle and updates `best`, which starts as nothing_yet(t_max).
inline void update_nearest(const PreparedRay& ray, const Triangle& triangle, std::uint32_t index,
                           Hit& best) {
  TriangleHit hit;
  if (intersect_triangle(ray, triangle, best.t, hit)) keep_nearer(hit, index, best);
}

}  // namespace pah
