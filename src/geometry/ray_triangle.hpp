// The one ray-triangle rule of the project. Every accelerator gives its answers to the last bit.
//
// The rule. A ray hits a triangle if and only if
//   1. the watertight test of Woop, Benthin and Wald ("Watertight Ray/Triangle Intersection", JCGT
//      2013) accepts: the ray's line meets the triangle, edges and vertices included, both faces;
//   2. the hit is in front of the origin beyond doubt: either all three vertices are, or t exceeds
//      its error bound (pbrt-v4, 6.8.5 "Robust Triangle Intersections");
//   3. t is at most t_max.
// Among hits the least (t, triangle index) wins.
//
// Why no acceleration changes an answer. The rule depends on the ray and the triangle only, and its
// t lies in the interval of every box around the triangle or around the part of it that is hit
// (ray_box.hpp). A traversal that skips a node only if its interval is empty or near(node) > t of a
// hit already found can therefore not skip the winner, whatever the tree and the order.
//
// Why origin + t d lies within 30 u M of a point of the triangle (u the unit roundoff, M the
// largest distance along an axis from the origin O to a vertex V). The test sees vertices that are
// off by roundings: with |shear| <= 1, x - shear * z is off by u M (x) + 4 u M (shear * z: shear is
// a product with a reciprocal) + 2 u M (difference) = 7 u M. Of these vertices the edge functions
// have the exact sign: rounding is monotone, so a float difference of float products errs in sign
// only by being zero, and then doubles decide (products of floats are exact in double). So the line
// meets the triangle of the rounded vertices, at weights that make a point of the true triangle, 7
// u M away at most. Their sum of depths is t: weighted depths have 9 roundings at most (two of the
// depth, sum of edge functions, inverse, product, product, sum), which is 9 u Z, Z being the
// largest depth. What is left is the error of the edge functions. In double they have all digits.
// In float each is off by 2 u X Y and u of itself at most, X and Y being the largest |x| and |y|.
// As t = sum of e z / sum of e, that moves t by 6 u X Y R / |determinant| + u R, R being the range
// of depths. Where X Y R > 2 Z |determinant|, doubles take over; else that is 12 u Z + 2 u Z.
// Together: 7 u M + 23 u M.
//
// Two triangles with a shared edge compute its edge function with opposite signs and the same
// digits, hence no crack.
#pragma once

#include <algorithm>
#include <cmath>
#include <pah/geometry/triangles.hpp>

#include "geometry/ray_box.hpp"

namespace pah {

// All of it is inlined: kernels are compiled for other instruction sets than the rest, and calls
// between the two cost more than what is called.

struct TriangleHit {
  float t = 0;
  float u = 0;
  float v = 0;
};

namespace detail {

// A vertex as the ray sees it: the ray is the z axis.
struct ShearedVertex {
  float x, y, z;
  float t;  // z in units of the direction
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

// Twice the areas that the origin spans with the edges opposite to a, b and c.
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

// How far the vertices are from the ray, and along it.
struct Extent {
  float x, y, z;            // largest size of each
  float nearest, farthest;  // t
  float depth;              // largest size of t

  [[gnu::always_inline]] Extent(const ShearedVertex& p, const ShearedVertex& q,
                                const ShearedVertex& r)
      : x(largest_size(p.x, q.x, r.x)),
        y(largest_size(p.y, q.y, r.y)),
        z(largest_size(p.z, q.z, r.z)),
        nearest(std::min(p.t, std::min(q.t, r.t))),
        farthest(std::max(p.t, std::max(q.t, r.t))),
        depth(std::max(std::abs(nearest), std::abs(farthest))) {}
};

// Where float loses no digits to its range.
inline constexpr float least_determinant = 0x1p-100F;
inline constexpr float most_determinant = 0x1p100F;

// Whether float has the digits that t needs: see the top of this file.
[[nodiscard, gnu::always_inline]] inline bool well_conditioned(const EdgeFunctions<float>& edge,
                                                               const Extent& extent) {
  if (edge.a == 0 || edge.b == 0 || edge.c == 0) return false;
  const float size = std::abs(edge.determinant());
  if (!(size >= least_determinant && size <= most_determinant)) return false;
  return extent.x * (1 / size) * extent.y * (extent.farthest - extent.nearest) <= 2 * extent.depth;
}

// How far t can be from the truth, at most (pbrt-v4, 6.8.5): what decides its sign. 5 roundings
// make depths, 7 their weighted sum.
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

// A hit if the ray's line meets the triangle, as its edge functions say.
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

// Whether the ray hits the triangle at a t of at most `t_limit`; `hit` holds rubbish if not. The
// caller decides ties.
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

// A search starts with no triangle at t_max and ends, if none is found, at infinity.
[[nodiscard, gnu::always_inline]] inline Hit nothing_yet(float t_max) {
  Hit hit;
  hit.t = t_max;
  return hit;
}
[[nodiscard, gnu::always_inline]] inline Hit finished(const Hit& hit) {
  return hit.valid() ? hit : Hit{};
}

// Keeps the nearer of `best` and a hit at no larger t: the lower index where t is equal.
[[gnu::always_inline]] inline void keep_nearer(const TriangleHit& hit, std::uint32_t index,
                                               Hit& best) {
  if (hit.t < best.t || index < best.triangle) best = {hit.t, hit.u, hit.v, index};
}

// The same for a triangle's hit, if any. `best` starts out as no triangle at the ray's t_max.
inline void update_nearest(const PreparedRay& ray, const Triangle& triangle, std::uint32_t index,
                           Hit& best) {
  TriangleHit hit;
  if (intersect_triangle(ray, triangle, best.t, hit)) keep_nearer(hit, index, best);
}

}  // namespace pah
