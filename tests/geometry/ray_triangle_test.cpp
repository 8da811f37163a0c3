// Tests the ray-triangle rule: it is watertight, never hits outside the triangle, and is exactly
// scale-invariant.
#include "geometry/ray_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "support/soups.hpp"

using namespace pah;
using test::Soup;

namespace {

// A closed mesh of latitudes and longitudes around `center`, with shared vertices at the poles.
Soup sphere(std::uint32_t rings, double radius, const Vec3& center) {
  Soup soup;
  soup.name = "sphere";
  const std::uint32_t columns = 2 * rings;
  const auto vertex = [&](std::uint32_t ring, std::uint32_t column) -> std::uint32_t {
    if (ring == 0) return 0;
    if (ring == rings) return 1;
    return 2 + (ring - 1) * columns + column % columns;
  };
  const auto place = [&](double x, double y, double z) {
    soup.positions.push_back(center + Vec3(DVec3{x, y, z} * radius));
  };
  place(0, 1, 0);
  place(0, -1, 0);
  for (std::uint32_t ring = 1; ring < rings; ++ring) {
    const double theta = std::numbers::pi * ring / rings;
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double phi = 2 * std::numbers::pi * column / columns;
      place(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const UVec3 upper{vertex(ring, column), vertex(ring, column + 1), vertex(ring + 1, column)};
      const UVec3 lower{vertex(ring, column + 1), vertex(ring + 1, column + 1),
                        vertex(ring + 1, column)};
      if (ring > 0) soup.indices.push_back(upper);
      if (ring + 1 < rings) soup.indices.push_back(lower);
    }
  }
  return soup;
}

// An axis-aligned closed box, each face a grid of cells.
Soup cube(std::uint32_t cells, double radius, const Vec3& center) {
  Soup soup;
  soup.name = "cube";
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(soup.positions.size());
      for (std::uint32_t j = 0; j <= cells; ++j) {
        for (std::uint32_t i = 0; i <= cells; ++i) {
          DVec3 p;
          p[axis] = side;
          p[(axis + 1) % 3] = 2.0 * i / cells - 1;
          p[(axis + 2) % 3] = 2.0 * j / cells - 1;
          soup.positions.push_back(center + Vec3(p * radius));
        }
      }
      for (std::uint32_t j = 0; j < cells; ++j) {
        for (std::uint32_t i = 0; i < cells; ++i) {
          const std::uint32_t k = first + j * (cells + 1) + i;
          soup.indices.emplace_back(k, k + 1, k + cells + 1);
          soup.indices.emplace_back(k + 1, k + cells + 2, k + cells + 1);
        }
      }
    }
  }
  return soup;
}

// A point on an edge or at a vertex, up to float rounding.
Vec3 edge_point(const Triangle& triangle, test::Random& random) {
  if (random.below(2) == 0) return triangle.a;
  const float f = random.below(2) == 0 ? 0.5F : random.uniform(0, 1);
  return triangle.a + f * (triangle.b - triangle.a);
}

// Rays that start inside a closed mesh and are aimed at its edges and vertices.
void count_leaks(std::uint32_t rays_per_mesh) {
  for (const double radius : {1e-6, 1e-2, 1.0, 1e3, 1e7}) {
    for (const double offset : {0.0, 10.0, 1e3, 1e6}) {
      const Vec3 center{DVec3{offset, -0.7 * offset, 0.3 * offset} * radius};
      for (const bool round : {true, false}) {
        const Soup mesh = round ? sphere(16, radius, center) : cube(8, radius, center);
        INFO(mesh.name << ", radius " << radius << ", offset " << offset);
        const Triangles triangles = mesh.triangles();
        // Tests every triangle of the small mesh, so that no culling hides a leak.
        const auto accelerator = make_brute_force(triangles);
        test::Random random(7);
        const auto r = static_cast<float>(radius);
        std::vector<Ray> rays(rays_per_mesh);
        for (Ray& ray : rays) {
          ray.origin = center + 0.3F * r * random.in_box({Vec3{-1}, Vec3{1}});
          if (random.below(4) == 0) ray.origin = center;
          const Triangle target =
              triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
          ray.direction = edge_point(target, random) - ray.origin;
          if (random.below(2) == 0) ray.direction = glm::normalize(ray.direction / r);
        }
        std::vector<std::uint8_t> hit(rays.size());
        accelerator->occluded(rays, hit);
        std::uint32_t leaks = 0;
        for (const std::uint8_t h : hit) leaks += h == 0 ? 1 : 0;
        CHECK(leaks == 0);
      }
    }
  }
}

// The hit point in double, and the largest allowed distance outside the triangle's box: 30
// roundings of the distance to its vertices (ray_triangle.hpp).
bool inside_box(const Ray& ray, const Triangle& triangle, const TriangleHit& hit) {
  const Aabb box = triangle.bounds();
  const Vec3 reach = glm::max(glm::abs(box.min - ray.origin), glm::abs(box.max - ray.origin));
  const double bound = double{rounding_bound(31)} * double{largest_of(reach)};
  for (int i = 0; i < 3; ++i) {
    const double x = double{ray.origin[i]} + double{hit.t} * double{ray.direction[i]};
    if (x < double{box.min[i]} - bound || x > double{box.max[i]} + bound) return false;
  }
  return true;
}

Triangle needle(test::Random& random) {
  const Aabb unit{Vec3{-1}, Vec3{1}};
  const Vec3 a = random.in_box(unit);
  const Vec3 b = random.in_box(unit);
  const float width = std::ldexp(1.0F, -static_cast<int>(random.below(30)));
  switch (random.below(3)) {
    case 0:
      return {a, b, b + width * random.in_box(unit)};
    case 1:
      return {a, b, a + random.uniform(0, 1) * (b - a) + width * random.in_box(unit)};
    default:
      return {a, a + width * random.in_box(unit), a + width * random.in_box(unit)};
  }
}

}  // namespace

TEST_CASE("No ray leaves a closed mesh through its edges and vertices") { count_leaks(2500); }
TEST_CASE("No ray leaves a closed mesh through its edges and vertices, 1e7 rays", "[full]") {
  count_leaks(250000);
}

TEST_CASE("Needles and triangles seen edge-on are hit only inside their box") {
  test::Random random(3);
  std::uint32_t hits = 0;
  std::uint32_t outside = 0;
  std::uint32_t bad_weights = 0;
  for (int i = 0; i < 1000000; ++i) {
    const Triangle triangle = needle(random);
    Ray ray{random.in_box({Vec3{-3}, Vec3{3}}), 1e30F, {}, no_bundle};
    const float f = random.uniform(0, 1);
    const float g = random.uniform(0, 1 - f);
    const Vec3 target = triangle.a + f * (triangle.b - triangle.a) + g * (triangle.c - triangle.a);
    if (random.below(2) == 0) {  // in the plane, up to rounding
      ray.origin = target - random.uniform(-3, 3) * (triangle.b - triangle.a) -
                   random.uniform(-3, 3) * (triangle.c - triangle.a);
    }
    ray.direction = target - ray.origin;
    TriangleHit hit;
    const PreparedRay prepared = prepare(ray);
    if (!intersect_triangle(prepared, triangle, prepared.t_max, hit)) continue;
    ++hits;
    outside += inside_box(ray, triangle, hit) ? 0 : 1;
    bad_weights += hit.u >= 0 && hit.u <= 1 && hit.v >= 0 && hit.v <= 1 &&
                           hit.u + hit.v <= 1 + 4 * unit_roundoff
                       ? 0
                       : 1;
  }
  CHECK(hits > 100000);
  CHECK(outside == 0);
  CHECK(bad_weights == 0);
}

TEST_CASE("Hits agree with double arithmetic where the triangle is well-shaped") {
  test::Random random(4);
  const Aabb unit{Vec3{-1}, Vec3{1}};
  std::uint32_t compared = 0;
  for (int i = 0; i < 200000; ++i) {
    const Triangle triangle{random.in_box(unit), random.in_box(unit), random.in_box(unit)};
    const Ray ray{4.0F * random.in_box(unit), 1e30F, random.in_box(unit), no_bundle};
    const DVec3 a{triangle.a};
    const DVec3 ab = DVec3{triangle.b} - a;
    const DVec3 ac = DVec3{triangle.c} - a;
    const DVec3 d{ray.direction};
    const DVec3 p = glm::cross(d, ac);
    const double determinant = glm::dot(ab, p);
    if (std::abs(determinant) < 0.05) continue;
    const DVec3 s = DVec3{ray.origin} - a;
    const DVec3 q = glm::cross(s, ab);
    const double u = glm::dot(s, p) / determinant;
    const double v = glm::dot(d, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    const double edge = std::min(std::min(u, v), 1 - u - v);
    if (std::abs(edge) < 1e-4 || std::abs(t) < 1e-4) continue;
    ++compared;
    TriangleHit hit;
    const PreparedRay prepared = prepare(ray);
    const bool found = intersect_triangle(prepared, triangle, prepared.t_max, hit);
    REQUIRE(found == (edge > 0 && t > 0));
    if (!found) continue;
    REQUIRE(std::abs(double{hit.t} - t) < 1e-3);
    REQUIRE(std::abs(double{hit.u} - u) < 1e-3);
    REQUIRE(std::abs(double{hit.v} - v) < 1e-3);
  }
  CHECK(compared > 10000);
}

TEST_CASE("A ray does not hit the triangle on whose corner or inside it starts") {
  test::Random random(5);
  const Aabb unit{Vec3{-1}, Vec3{1}};
  std::uint32_t self_hits = 0;
  for (int i = 0; i < 200000; ++i) {
    const Triangle triangle = random.below(2) == 0
                                  ? needle(random)
                                  : Triangle{random.in_box(unit), random.in_box(unit), Vec3{0}};
    const Ray ray{triangle.a, 1e30F, random.in_box(unit), no_bundle};
    TriangleHit hit;
    const PreparedRay prepared = prepare(ray);
    self_hits += intersect_triangle(prepared, triangle, prepared.t_max, hit) ? 1 : 0;
  }
  CHECK(self_hits == 0);
}

TEST_CASE("A hit from near a triangle's surface is certainly in front of the origin") {
  test::Random random(13);
  const Aabb unit{Vec3{-1}, Vec3{1}};
  std::uint32_t hits = 0;
  std::uint32_t behind = 0;
  for (int i = 0; i < 300000; ++i) {
    const Triangle triangle{random.in_box(unit), random.in_box(unit), random.in_box(unit)};
    const float f = random.uniform(0, 1);
    const float g = random.uniform(0, 1 - f);
    Ray ray{triangle.a + f * (triangle.b - triangle.a) + g * (triangle.c - triangle.a), 1e30F,
            random.in_box(unit), no_bundle};
    ray.origin += std::ldexp(1.0F, -20 - static_cast<int>(random.below(6))) * random.in_box(unit);
    const PreparedRay prepared = prepare(ray);
    TriangleHit hit;
    if (!intersect_triangle(prepared, triangle, prepared.t_max, hit)) continue;
    ++hits;
    const DVec3 a{triangle.a};
    const DVec3 normal = glm::cross(DVec3{triangle.b} - a, DVec3{triangle.c} - a);
    behind += glm::dot(a - DVec3{ray.origin}, normal) * glm::dot(DVec3{ray.direction}, normal) < 0;
  }
  CHECK(hits > 10);  // the far ones
  CHECK(behind == 0);
}

TEST_CASE("Scaling a scene by a power of two scales t by it to the last bit") {
  const Soup soup = test::random_soup(50, 0.5F, {3, -2, 1}, 6);
  const std::vector<Ray> rays = test::rays_for(soup, 2000, 8);
  for (int k = -20; k <= 20; ++k) {
    const float scale = std::ldexp(1.0F, k);
    Soup scaled = soup;
    for (Vec3& p : scaled.positions) p *= scale;
    std::uint32_t different = 0;
    for (Ray ray : rays) {
      ray.t_max = 1e30F;
      const PreparedRay prepared = prepare(ray);
      ray.origin *= scale;
      const PreparedRay far = prepare(ray);
      ray.direction *= scale;
      const PreparedRay longer = prepare(ray);
      for (std::size_t i = 0; i < soup.indices.size(); ++i) {
        TriangleHit a;
        TriangleHit b;
        TriangleHit c;
        const bool hit = intersect_triangle(prepared, soup.triangles()[i], 1e30F, a);
        const bool hit_far = intersect_triangle(far, scaled.triangles()[i], 1e36F, b);
        const bool hit_longer = intersect_triangle(longer, scaled.triangles()[i], 1e30F, c);
        const bool same = hit == hit_far && hit == hit_longer &&
                          (!hit || (b.t == scale * a.t && c.t == a.t && b.u == a.u && c.u == a.u &&
                                    b.v == a.v && c.v == a.v));
        different += same ? 0 : 1;
      }
    }
    CHECK(different == 0);
  }
}
