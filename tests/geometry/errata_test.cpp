// Tests of formulas that are wrong as printed in the thesis: those of appendix A, and those of
// chapter 5 that need only a region or a polygon. Each printed formula stands beside the correct
// one, so that nobody "corrects" the code back. CONTRIBUTING.md lists all such tests.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <pah/geometry/basis.hpp>
#include <pah/geometry/convex_polygon.hpp>
#include <pah/geometry/plane.hpp>
#include <pah/geometry/region.hpp>
#include <stdexcept>

#include "catch.hpp"
#include "geometry/ray_triangle.hpp"

using namespace pah;

namespace {

constexpr float endless = std::numeric_limits<float>::infinity();

struct Slab {
  float near, far;
};

// Algorithm A.1, lines 2 to 13; `lower` and `upper` are the chosen min and max functions.
template <typename Lower, typename Upper>
Slab printed_slabs(const Ray& ray, const Aabb& box, Lower lower, Upper upper) {
  Slab slab{-endless, endless};
  for (int k = 0; k < 3; ++k) {
    const float t1 = (box.min[k] - ray.origin[k]) / ray.direction[k];
    const float t2 = (box.max[k] - ray.origin[k]) / ray.direction[k];
    slab.near = k == 0 ? lower(t1, t2) : upper(slab.near, lower(t1, t2));
    slab.far = k == 0 ? upper(t1, t2) : lower(slab.far, upper(t1, t2));
  }
  return slab;
}

// min and max: by a comparison, or by IEEE 754's functions, which skip NaN.
Slab printed_slabs(const Ray& ray, const Aabb& box) {
  return printed_slabs(
      ray, box, [](float a, float b) { return std::min(a, b); },
      [](float a, float b) { return std::max(a, b); });
}
Slab printed_slabs_past_nan(const Ray& ray, const Aabb& box) {
  return printed_slabs(
      ray, box, [](float a, float b) { return std::fmin(a, b); },
      [](float a, float b) { return std::fmax(a, b); });
}

// Line 14.
bool printed_collides(const Slab& slab) { return slab.far > slab.near && slab.far >= 0; }

bool meets(const Ray& ray, const Aabb& box) {
  const SlabInterval interval = intersect_box(prepare(ray), padded(box));
  return interval.near <= interval.far;
}

// Algorithm A.2, which returns the ray's t.
std::optional<double> printed_ray_plane(const Ray& ray, const DVec3& normal,
                                        const DVec3& /*point: of D, which is then not used*/) {
  const double slope = glm::dot(normal, DVec3(ray.direction));
  if (slope == 0) return {};
  const double t = -glm::dot(normal, DVec3(ray.origin)) / slope;
  if (t < 0) return {};
  return t;
}
// The last formula before algorithm A.2.
double printed_ray_plane_formula(const Ray& ray, const DVec3& normal, const DVec3& point) {
  const double d = -glm::dot(normal, point);
  return (-glm::dot(normal, DVec3(ray.origin)) + d) / glm::dot(normal, DVec3(ray.direction));
}

// Algorithm A.4, in space; `wrapped`: hull[N] is hull[0], not past the end as printed.
template <typename Vertices>
bool printed_inside(const DVec3& p, const Vertices& hull, bool wrapped) {
  const std::size_t n = hull.size();
  const DVec3 reference = glm::cross(hull[0] - hull[n - 1], p - hull[n - 1]);
  for (std::size_t i = 0; i < n; ++i) {
    const DVec3 next = hull.at(wrapped ? (i + 1) % n : i + 1);
    if (glm::dot(reference, glm::cross(next - hull[i], p - hull[i])) <= 0) return false;
  }
  return true;
}

// A.3, with A.2 corrected.
bool printed_ray_triangle(const Ray& ray, const Triangle& triangle) {
  const std::array<DVec3, 3> corners{DVec3(triangle.a), DVec3(triangle.b), DVec3(triangle.c)};
  const DVec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const auto t = intersection(plane_through(corners[0], normal), ray);
  return t && printed_inside(DVec3(ray.origin) + *t * DVec3(ray.direction), corners, true);
}

bool hits(const Ray& ray, const Triangle& triangle) {
  TriangleHit hit;
  return intersect_triangle(prepare(ray), triangle, ray.t_max, hit);
}

// A.9.2.
std::optional<DVec2> printed_crossing(const DVec2& m, const DVec2& n, const DVec2& p,
                                      const DVec2& q) {
  const DVec3 first(n.y - m.y, m.x - n.x, (n.y - m.y) * m.x + (m.x - n.x) * m.y);
  const DVec3 second(q.y - p.y, p.x - q.x, (q.y - p.y) * p.x + (p.x - q.x) * p.y);
  const double delta = first.x * second.y - second.x * first.y;
  const DVec2 k((second.y * first.z - first.y * second.z) / delta,
                (first.x * second.z - second.x * first.z) / delta);
  const auto within = [&](const DVec2& u, const DVec2& v) {
    return std::min(u.x, v.x) <= k.x && std::max(u.x, v.x) >= k.x && std::min(u.y, v.y) <= k.y &&
           std::max(u.y, v.y) >= k.y;
  };
  if (within(m, n) && within(p, q)) return k;
  return {};
}

std::vector<DVec3> in_space(const ConvexPolygon& polygon) {
  std::vector<DVec3> points;
  for (const DVec2& v : polygon) points.emplace_back(v, 0);
  return points;
}

// A.9: vertices inside, crossings of edges, sorted by their angle about the barycenter.
ConvexPolygon printed_culling(const ConvexPolygon& a, const ConvexPolygon& b) {
  ConvexPolygon common;
  for (const DVec2& v : a)
    if (printed_inside(DVec3(v, 0), in_space(b), true)) common.push_back(v);
  for (const DVec2& v : b)
    if (printed_inside(DVec3(v, 0), in_space(a), true)) common.push_back(v);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k)
      if (const auto crossing =
              printed_crossing(a[i], a[(i + 1) % a.size()], b[k], b[(k + 1) % b.size()]))
        common.push_back(*crossing);
  DVec2 center(0);
  for (const DVec2& v : common) center += v / static_cast<double>(common.size());
  std::ranges::sort(common, {},
                    [&](const DVec2& v) { return std::atan2(v.y - center.y, v.x - center.x); });
  return common;
}

// A.10, the determinants | x0 y1 ; y0 y1 | and so on.
double printed_area(const ConvexPolygon& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DVec2& next = polygon[(i + 1) % polygon.size()];
    sum += polygon[i].x * next.y - next.y * polygon[i].y;
  }
  return std::abs(0.5 * sum);
}

// A.7 with equation 5.4. `row_of_w` is the matrix's last row: all 0 in the draft, which has (0, 0,
// -1, 0) as a fifth column. If that is the row, w is -z, as for a view along -z, but depth is
// scaled as for a view along z.
bool printed_in_frustum(const DVec3& p, const DVec2& tan_half, double near, double far,
                        const glm::dvec4& row_of_w) {
  const DVec2 side = near * tan_half;
  const DVec3 projected(near / side.x * p.x, near / side.y * p.y,
                        (far + near) / (far - near) * p.z - 2 * far * near / (far - near));
  const double w = glm::dot(row_of_w, glm::dvec4(p, 1));
  return glm::all(glm::lessThanEqual(DVec3(-w), projected)) &&
         glm::all(glm::lessThanEqual(projected, DVec3(w)));
}

// Before equation 5.3.
DVec3 printed_right(const DVec3& forward) {
  const DVec3 world_up(0, 1, 0);
  return glm::cross(world_up, forward);
}

const ConvexPolygon square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};

}  // namespace

// A.1, line 14: `>`.
TEST_CASE("A ray meets a box without thickness, which the printed slab test misses") {
  const Aabb flat = Triangle{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}}.bounds();
  for (const Vec3& direction : {Vec3(0.1F, 0.05F, 1), Vec3(0, 0, 1)}) {
    const Ray ray{Vec3(0), endless, direction};
    const Slab slab = printed_slabs(ray, flat);
    CHECK(slab.near == 2);
    CHECK(slab.far == 2);
    CHECK_FALSE(printed_collides(slab));
    CHECK(meets(ray, flat));
  }
}

// A.1: "under the floating-point IEEE 754 standard, the algorithm also works".
TEST_CASE("A ray within a face meets the box, where the printed slab test divides 0 by 0") {
  const Aabb box{{0, 0, 0}, {1, 1, 1}};
  for (const float x : {0.0F, 1.0F}) {
    const Ray ray{{x, 0.5F, -1}, endless, {0, 0, 1}};
    CHECK_FALSE(printed_collides(printed_slabs(ray, box)));
    CHECK_FALSE(printed_collides(printed_slabs_past_nan(ray, box)));
    CHECK(meets(ray, box));
  }
}

// A.1: a rounded interval must be widened.
TEST_CASE("A ray past an edge meets the box, which the printed slab test misses by a rounding") {
  const Ray ray{{0.3F, -0.3F, 0}, endless, {10, 25, 0}};
  const Aabb box{{1.5F, -1, -1}, {3, 2.7F, 1}};
  // The ray enters at the lower x before it leaves at the upper y. This is exact: double holds
  // differences of these floats and their products with small integers.
  REQUIRE((double{box.min.x} - double{ray.origin.x}) * 25 <
          (double{box.max.y} - double{ray.origin.y}) * 10);
  const Slab slab = printed_slabs(ray, box);
  CHECK_FALSE(slab.far >= slab.near);
  CHECK(meets(ray, box));
}

// A.2, line 9 and the formula before it.
TEST_CASE("A ray crosses a plane where it is, not where the printed formulas place it") {
  const Ray ray{{1, 2, 10}, endless, {0, 0, -2}};
  const DVec3 point(7, -5, 4), normal(0, 0, 3);
  const Plane plane = plane_through(point, normal);
  CHECK(intersection(plane, ray) == 3.0);               // from z = 10 to z = 4 by 2
  CHECK(printed_ray_plane(ray, normal, point) == 5.0);  // as if the plane ran through the origin
  CHECK(printed_ray_plane_formula(ray, normal, point) == 7.0);
  // Beyond the origin's plane the printed algorithm finds nothing.
  const Ray beyond{{0, 0, -1}, endless, {0, 0, -1}};
  CHECK_FALSE(printed_ray_plane(beyond, normal, {0, 0, -3}).has_value());
  CHECK(intersection(plane_through({0, 0, -3}, normal), beyond) == 2.0);
}

TEST_CASE("A ray crosses a plane once, in front of its origin and not beyond its end") {
  const Plane plane = plane_through({0, 0, 1}, {0, 0, 1});
  const auto crossing = [&](const Vec3& origin, const Vec3& direction, float t_max = endless) {
    return intersection(plane, Ray{origin, t_max, direction});
  };
  CHECK(crossing({0, 0, 0}, {1, 2, 0.5F}) == 2.0);
  CHECK(crossing({0, 0, 0}, {1, 2, 0.5F}, 2) == 2.0);
  CHECK_FALSE(crossing({0, 0, 0}, {1, 2, 0.5F}, 1.999F).has_value());
  CHECK(crossing({0, 0, 2}, {0, 0, -1}) == 1.0);            // from either side
  CHECK_FALSE(crossing({0, 0, 2}, {0, 0, 1}).has_value());  // behind
  CHECK_FALSE(crossing({0, 0, 1}, {0, 0, 1}).has_value());  // from the plane
  CHECK_FALSE(crossing({0, 0, 0}, {1, 0, 0}).has_value());  // parallel
  CHECK_FALSE(crossing({0, 0, 1}, {1, 0, 0}).has_value());  // within
  CHECK_FALSE(crossing({0, 0, 0}, {0, 0, 0}).has_value());
}

// A.3 with A.8's `<= 0`.
TEST_CASE("A ray through a shared edge hits, though it misses both triangles by the printed test") {
  const Triangle below{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Triangle above{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const Vec3& on_edge : {Vec3(0.5F, 0.5F, 0), Vec3(0.25F, 0.75F, 0), Vec3(1, 0, 0)}) {
    const Vec3 from(on_edge.x, on_edge.y, 1);
    const Ray ray{from, endless, on_edge - from};
    CHECK_FALSE(printed_ray_triangle(ray, below));
    CHECK_FALSE(printed_ray_triangle(ray, above));
    CHECK(hits(ray, below));
    CHECK(hits(ray, above));
  }
  CHECK(printed_ray_triangle({{0.25F, 0.25F, 1}, endless, {0, 0, -1}}, below));
}

// Algorithm A.4, line 7.
TEST_CASE("The printed inside-outside test reads past the last vertex") {
  const std::array<DVec3, 3> hull{DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0)};
  CHECK(printed_inside({0.25, 0.25, 0}, hull, true));
  CHECK_THROWS_AS(printed_inside({0.25, 0.25, 0}, hull, false), std::out_of_range);
  CHECK(contains(ConvexPolygon{{0, 0}, {1, 0}, {0, 1}}, DVec2(0.25, 0.25)));
}

// A.8 and algorithm A.4, line 10.
TEST_CASE("A polygon contains its boundary, which the printed test excludes") {
  const std::vector<DVec3> hull = in_space(square);
  for (const DVec2& p : {DVec2(0, 0), DVec2(2, 0), DVec2(4, 1), DVec2(4, 4)}) {
    CHECK_FALSE(printed_inside(DVec3(p, 0), hull, true));
    CHECK(contains(square, p));
  }
  CHECK(printed_inside({1, 2, 0}, hull, true));
  // The edge between equal vertices has no side.
  const ConvexPolygon repeated{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 4}};
  CHECK_FALSE(printed_inside({1, 2, 0}, in_space(repeated), true));
  CHECK(contains(repeated, DVec2(1, 2)));
}

// A.9.2: collinear edges have a delta of 0, and a horizontal or vertical edge leaves no room for
// rounding.
TEST_CASE("The printed crossing of edges is NaN, or off by an ulp") {
  CHECK_FALSE(printed_crossing({0, 0}, {1, 0}, {0.5, 0}, {2, 0}).has_value());
  CHECK_FALSE(printed_crossing({0.1, 0.1}, {0.5, 0.1}, {0.5, 0.1}, {0.5, 0.8}).has_value());
  const ConvexPolygon unit{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const ConvexPolygon half_beside{{0.5, 0}, {2, 0}, {2, 1}, {0.5, 1}};
  CHECK(overlap_area(unit, half_beside) == 0.5);
}

// A.9.
TEST_CASE("Identical hulls overlap, which the printed culling misses") {
  // As printed, corners are not inner points, and crossings of edges miss their range by an ulp.
  const ConvexPolygon rectangle{{0.1, 0.1}, {0.5, 0.1}, {0.5, 0.8}, {0.1, 0.8}};
  const ConvexPolygon triangle{{0.81, 0.25}, {0.3, 0.66}, {0.34, 0.42}};
  CHECK(printed_culling(rectangle, rectangle).empty());
  CHECK(printed_culling(triangle, triangle).empty());
  CHECK(overlap_area(rectangle, rectangle) == area(rectangle));
  CHECK(overlap_area(triangle, triangle) == area(triangle));
  CHECK(area(rectangle) == Approx(0.4 * 0.7));
  CHECK(area(triangle) == Approx(0.5 * (0.41 * 0.47 - 0.51 * 0.17)));
  // The printed test is right where neither touches a vertex or an edge of the other.
  const ConvexPolygon turned{{2, -1}, {5, 2}, {2, 5}, {-1, 2}};
  CHECK(area(printed_culling(square, turned)) == Approx(14));
  CHECK(overlap_area(square, turned) == Approx(14));
}

// A.10.
TEST_CASE("The printed determinants are no areas") {
  const ConvexPolygon rectangle{{1, 0}, {3, 0}, {3, 5}, {1, 5}};
  CHECK(printed_area(rectangle) != Approx(10));
  CHECK(area(rectangle) == 10);
  // Twice the triangle's area is one determinant, which a translation does not change; the printed
  // one changes.
  CHECK(printed_area({{0, 0}, {2, 0}, {0, 3}}) != Approx(printed_area({{1, 1}, {3, 1}, {1, 4}})));
  CHECK(area(ConvexPolygon{{0, 0}, {2, 0}, {0, 3}}) == 3);
  CHECK(area(ConvexPolygon{{1, 1}, {3, 1}, {1, 4}}) == 3);
}

// A.7 with equation 5.4.
TEST_CASE("No point is in a frustum by the printed matrix, in either direction of view") {
  const double near = 1, far = 10;
  const Region ours = Frustum{DVec3(0), DMat3(1.0), DVec2(1), near, far};
  for (const glm::dvec4& row_of_w : {glm::dvec4(0), glm::dvec4(0, 0, -1, 0)})
    for (const float z : {1.25F, 2.0F, 5.0F, 10.0F})
      for (const float x : {-0.5F, 0.0F, 0.5F}) {
        const Vec3 point(x * z, 0, z);
        const DVec3 behind(point.x, point.y, -point.z);
        CHECK_FALSE(printed_in_frustum(DVec3(point), DVec2(1), near, far, row_of_w));
        CHECK_FALSE(printed_in_frustum(behind, DVec2(1), near, far, row_of_w));
        CHECK(contains(ours, point));
      }
}

// Equation 5.3.
TEST_CASE("A view straight down has a basis, which the printed one lacks") {
  const DVec3 down(0, -1, 0);
  CHECK(printed_right(down) == DVec3(0));
  const DMat3 basis = orthonormal_basis(down);
  CHECK(basis[2] == down);
  CHECK(glm::length(basis[0]) == Approx(1));
  CHECK(glm::cross(basis[0], basis[1]) == down);
}
