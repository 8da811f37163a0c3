// The one ray-triangle rule of the project. Every accelerator gives its answers to the last bit.
//
// The rule. A ray hits a triangle if and only if
//   1. the watertight test of Woop, Benthin and Wald ("Watertight Ray/Triangle Intersection", JCGT
//      2013) accepts: the ray's line meets the triangle, edges and vertices included, both faces;
//   2. the ray's slab interval [near, far] of the triangle's OWN padded box (ray_box.hpp) is not
//      empty;
//   3. the hit is in front of the origin beyond doubt: either the whole interval is (near > 0) or t
//      exceeds its error bound (pbrt-v4, 6.8.5 "Robust Triangle Intersections");
//   4. t, clamped to [near, far], is at most t_max.
// Among hits the least (t, triangle index) wins.
//
// Why no acceleration changes an answer. The rule depends on the ray and the triangle only. A box
// of a tree contains its triangles' padded boxes exactly, and a node's test is no narrower than
// the triangle's (ray_box.hpp); so a node's interval contains the interval of each triangle below
// it, in which the reported t lies: near(node) <= t <= far(node). A traversal that skips a node
// only if its interval is empty or near(node) > t of a hit already found can therefore not skip the
// winner, whatever the tree and the order.
//
// Why the box takes no hit away. Edge functions have the exact sign for the sheared, rounded
// vertices: rounding is monotone, so a float difference of float products errs in sign only by
// being zero, and then doubles decide (products of floats are exact in double). The line thus meets
// a triangle whose vertices are off by a rounding: with u the unit roundoff, |V - O| <= M and
// |shear| <= 1, x - shear * z is off by u M (x) + 4 u M (shear * z: shear is a product with a
// reciprocal) + 2 u M (difference) = 7 u M.
// The padding of ray_box.hpp is larger than that. Two triangles with a shared edge compute its edge
// function with opposite signs and the same digits, hence no crack.
#pragma once

#include <algorithm>
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

// A vertex as the ray sees it: the ray is the z axis, z is not yet in units of t.
struct ShearedVertex {
  float x, y, z;
};

[[nodiscard, gnu::always_inline]] inline ShearedVertex shear(const PreparedRay& ray,
                                                             const Vec3& vertex) {
  const float* const along = &vertex.x;
  const auto [x, y, z] = ray.axes;
  const float depth = along[z] - ray.origin[2];
  return {(along[x] - ray.origin[0]) - ray.shear_x * depth,
          (along[y] - ray.origin[1]) - ray.shear_y * depth, depth};
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

// Where float loses no digits.
inline constexpr float least_determinant = 0x1p-100F;
inline constexpr float most_determinant = 0x1p100F;

// How far t can be from the truth, at most (pbrt-v4, 6.8.5): what decides its sign.
[[nodiscard, gnu::always_inline]] inline double distance_error(const ShearedVertex& p,
                                                               const ShearedVertex& q,
                                                               const ShearedVertex& r,
                                                               float scale_z,
                                                               const Barycentrics& weights) {
  const auto largest = [](float a, float b, float c) __attribute__((always_inline)) {
    return std::max(std::abs(a), std::max(std::abs(b), std::abs(c)));
  };
  const float z = largest(p.z, q.z, r.z);
  const float x = largest(p.x, q.x, r.x);
  const float y = largest(p.y, q.y, r.y);
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

  // Next, because it is cheap and rejects what is behind the origin or beyond the limit.
  const SlabInterval interval = intersect_box(ray, padded(triangle.bounds()));
  if (!(interval.near <= std::min(interval.far, t_limit))) return false;

  // Doubles decide zeros, and take over where float would lose digits at the ends of its range.
  const float determinant = std::abs(edge.a + edge.b + edge.c);
  const bool easy = edge.a != 0 && edge.b != 0 && edge.c != 0 &&
                    determinant >= detail::least_determinant &&
                    determinant <= detail::most_determinant;
  detail::Barycentrics weights;
  if (easy) {
    weights = detail::barycentrics(edge);
  } else {
    const detail::EdgeFunctions<double> exact(p, q, r);
    if (exact.mixed_signs()) return false;
    weights = detail::barycentrics(exact);
  }
  if (weights.inverse_determinant == 0) return false;

  const float depth = weights.a * p.z + weights.b * q.z + weights.c * r.z;
  const float t = depth * ray.scale_z;
  if (!(interval.near > 0 || double{t} > detail::distance_error(p, q, r, ray.scale_z, weights)))
    return false;
  hit = {std::min(std::max(t, interval.near), interval.far), weights.b, weights.c};
  return hit.t > 0 && hit.t <= t_limit;
}

// A search starts with no triangle at t_max and ends, if none is found, at infinity.
[[nodiscard, gnu::always_inline]] inline Hit nothing_yet(const PreparedRay& ray) {
  Hit hit;
  hit.t = ray.t_max;
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
