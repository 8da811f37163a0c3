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

 private:
  [[gnu::always_inline]] static Real cross(const ShearedVertex& p, const ShearedVertex& q) {
    return Real{p.x} * Real{q.y} - Real{p.y} * Real{q.x};
  }
};

struct Barycentrics {
  float a = 0, b = 0, c = 0;
  double inverse_determinant = 0;  // 0: the ray lies in the triangle's plane
  double largest = 0;              // edge function, by magnitude
};

template <typename Real>
[[nodiscard, gnu::always_inline]] inline Barycentrics barycentrics(
    const EdgeFunctions<Real>& edge) {
  const Real determinant = edge.a + edge.b + edge.c;
  if (!(std::abs(determinant) > 0)) return {};
  const Real inverse = 1 / determinant;
  const auto weight = [&](Real e) __attribute__((always_inline)) {
    return static_cast<float>(std::min(e * inverse, Real{1}));
  };
  return {weight(edge.a), weight(edge.b), weight(edge.c), double{inverse},
          double{std::max(std::abs(edge.a), std::max(std::abs(edge.b), std::abs(edge.c)))}};
}

// Where float loses no digits to its range.
inline constexpr float least_determinant = 0x1p-100F;
inline constexpr float most_determinant = 0x1p100F;

[[nodiscard, gnu::always_inline]] inline float least(float a, float b, float c) {
  return std::min(a, std::min(b, c));
}
[[nodiscard, gnu::always_inline]] inline float largest(float a, float b, float c) {
  return std::max(a, std::max(b, c));
}

// Whether float has the digits that t needs: see the top of this file.
[[nodiscard, gnu::always_inline]] inline bool well_conditioned(const ShearedVertex& p,
                                                               const ShearedVertex& q,
                                                               const ShearedVertex& r,
                                                               const EdgeFunctions<float>& edge) {
  if (edge.a == 0 || edge.b == 0 || edge.c == 0) return false;
  const float determinant = edge.a + edge.b + edge.c;
  const float size = std::abs(determinant);
  if (!(size >= least_determinant && size <= most_determinant)) return false;
  const float x = largest(std::abs(p.x), std::abs(q.x), std::abs(r.x));
  const float y = largest(std::abs(p.y), std::abs(q.y), std::abs(r.y));
  const float nearest = least(p.t, q.t, r.t);
  const float farthest = largest(p.t, q.t, r.t);
  const float depth = std::max(std::abs(nearest), std::abs(farthest));
  return x * (1 / size) * y * (farthest - nearest) <= 2 * depth;
}

// How far t can be from the truth, at most (pbrt-v4, 6.8.5): what decides its sign.
[[nodiscard, gnu::always_inline]] inline double distance_error(const ShearedVertex& p,
                                                               const ShearedVertex& q,
                                                               const ShearedVertex& r,
                                                               float scale_z,
                                                               const Barycentrics& weights) {
  const float z = largest(std::abs(p.z), std::abs(q.z), std::abs(r.z));
  const float x = largest(std::abs(p.x), std::abs(q.x), std::abs(r.x));
  const float y = largest(std::abs(p.y), std::abs(q.y), std::abs(r.y));
  const float error_x = rounding_bound(5) * (x + z);
  const float error_y = rounding_bound(5) * (y + z);
  const float error_edge = 2 * (rounding_bound(2) * x * y + error_y * x + error_x * y);
  // 3 roundings make z, 6 the sum of weighted z: product with the inverse, its own, product, sums.
  const double error = double{rounding_bound(9)} * weights.largest + double{error_edge};
  return 3 * error * std::abs(weights.inverse_determinant) * double{z} * double{std::abs(scale_z)};
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

  detail::Barycentrics weights;
  if (detail::well_conditioned(p, q, r, edge)) {
    weights = detail::barycentrics(edge);
  } else {
    const detail::EdgeFunctions<double> exact(p, q, r);
    if (exact.mixed_signs()) return false;
    weights = detail::barycentrics(exact);
  }
  if (weights.inverse_determinant == 0) return false;

  const float t = weights.a * p.t + weights.b * q.t + weights.c * r.t;
  if (!(t > 0 && t <= t_limit)) return false;
  hit = {t, weights.b, weights.c};
  return detail::least(p.t, q.t, r.t) > 0 ||
         double{t} > detail::distance_error(p, q, r, ray.scale_z, weights);
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
