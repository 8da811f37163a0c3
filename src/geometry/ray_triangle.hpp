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
// of a tree contains its triangles' padded boxes exactly, and the slab formula is monotone; so a
// node's interval contains the interval of each triangle below it, in which the reported t lies:
// near(node) <= t <= far(node). A traversal that skips a node only if its interval is empty or
// near(node) > t of a hit already found can therefore not skip the winner, whatever the tree and
// the order.
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

[[nodiscard]] inline ShearedVertex shear(const PreparedRay& ray, const Vec3& vertex) {
  const auto [x, y, z] = ray.axes;
  const float depth = vertex[z] - ray.origin[z];
  return {(vertex[x] - ray.origin[x]) - ray.shear_x * depth,
          (vertex[y] - ray.origin[y]) - ray.shear_y * depth, depth};
}

// Twice the areas that the origin spans with the edges opposite to a, b and c.
template <typename Real>
struct EdgeFunctions {
  Real a, b, c;

  EdgeFunctions(const ShearedVertex& p, const ShearedVertex& q, const ShearedVertex& r)
      : a(cross(r, q)), b(cross(p, r)), c(cross(q, p)) {}

  [[nodiscard]] bool mixed_signs() const {
    return (a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0);
  }

 private:
  static Real cross(const ShearedVertex& p, const ShearedVertex& q) {
    return Real{p.x} * Real{q.y} - Real{p.y} * Real{q.x};
  }
};

struct Barycentrics {
  float a = 0, b = 0, c = 0;
  double inverse_determinant = 0;  // 0: the ray lies in the triangle's plane
  double largest = 0;              // edge function, by magnitude
};

template <typename Real>
[[nodiscard]] Barycentrics barycentrics(const EdgeFunctions<Real>& edge) {
  const Real determinant = edge.a + edge.b + edge.c;
  if (!(std::abs(determinant) > 0)) return {};
  const Real inverse = 1 / determinant;
  const auto weight = [&](Real e) { return static_cast<float>(std::min(e * inverse, Real{1})); };
  return {weight(edge.a), weight(edge.b), weight(edge.c), double{inverse},
          double{std::max(std::abs(edge.a), std::max(std::abs(edge.b), std::abs(edge.c)))}};
}

// How far t can be from the truth, at most (pbrt-v4, 6.8.5): what decides its sign.
[[nodiscard]] inline double distance_error(const ShearedVertex& p, const ShearedVertex& q,
                                           const ShearedVertex& r, float scale_z,
                                           const Barycentrics& weights) {
  const auto largest = [](float a, float b, float c) {
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

// Parts 2 to 4 of the rule, for the few triangles that pass the signs of part 1.
[[nodiscard]] inline bool accept(const PreparedRay& ray, const Triangle& triangle,
                                 const ShearedVertex& p, const ShearedVertex& q,
                                 const ShearedVertex& r, const EdgeFunctions<float>& edge,
                                 float t_limit, TriangleHit& hit) {
  // First, because it is cheap and rejects what is behind the origin or beyond the limit.
  const SlabInterval interval = intersect_box(ray, padded(triangle.bounds()));
  if (!(interval.near <= std::min(interval.far, t_limit))) return false;

  // Doubles decide zeros, and take over where float would lose digits at the ends of its range.
  const float determinant = std::abs(edge.a + edge.b + edge.c);
  const bool easy = edge.a != 0 && edge.b != 0 && edge.c != 0 && determinant >= 0x1p-100F &&
                    determinant <= 0x1p100F;
  Barycentrics weights;
  if (easy) {
    weights = barycentrics(edge);
  } else {
    const EdgeFunctions<double> exact(p, q, r);
    if (exact.mixed_signs()) return false;
    weights = barycentrics(exact);
  }
  if (weights.inverse_determinant == 0) return false;

  const float depth = weights.a * p.z + weights.b * q.z + weights.c * r.z;
  const float t = depth * ray.scale_z;
  if (!(interval.near > 0 || double{t} > distance_error(p, q, r, ray.scale_z, weights)))
    return false;
  hit = {std::min(std::max(t, interval.near), interval.far), weights.b, weights.c};
  return hit.t > 0 && hit.t <= t_limit;
}

}  // namespace detail

// Whether the ray hits the triangle at a t of at most `t_limit`; `hit` holds rubbish if not. The
// caller decides ties.
[[nodiscard]] inline bool intersect_triangle(const PreparedRay& ray, const Triangle& triangle,
                                             float t_limit, TriangleHit& hit) {
  const detail::ShearedVertex p = detail::shear(ray, triangle.a);
  const detail::ShearedVertex q = detail::shear(ray, triangle.b);
  const detail::ShearedVertex r = detail::shear(ray, triangle.c);
  const detail::EdgeFunctions<float> edge(p, q, r);
  if (edge.mixed_signs()) return false;
  return detail::accept(ray, triangle, p, q, r, edge, t_limit, hit);
}

// Keeps the nearer of `best` and the triangle's hit, if any: the lower index where t is equal.
// `best` starts out as no triangle at the ray's t_max.
inline void update_nearest(const PreparedRay& ray, const Triangle& triangle, std::uint32_t index,
                           Hit& best) {
  TriangleHit hit;
  if (!intersect_triangle(ray, triangle, best.t, hit)) return;
  if (hit.t < best.t || index < best.triangle) best = {hit.t, hit.u, hit.v, index};
}

}  // namespace pah
