#include <cmath>
#include <pah/geometry/basis.hpp>
#include <pah/geometry/region.hpp>
#include <random>

#include "catch.hpp"

using namespace pah;

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
const double pi = std::acos(-1.0);

Frustum pyramid(const DVec3& forward, double far) {
  return {DVec3(0), orthonormal_basis(forward), DVec2(1), 0, far};
}

}  // namespace

TEST_CASE("A basis is orthonormal and right-handed for every direction") {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<DVec3> directions;
  for (int i = 0; i < 2000; ++i)
    directions.emplace_back(normal(random), normal(random), normal(random));
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) directions.emplace_back(x, y, z);
  directions.emplace_back(1e-9, -1e-9, -1);
  directions.emplace_back(0.0, -1.0, -0.0);
  directions.emplace_back(1e-160, 1e-200, -1e-150);
  for (const DVec3& d : directions) {
    if (glm::length(d) == 0) continue;
    const DMat3 m = orthonormal_basis(d);
    const DMat3 defect = glm::transpose(m) * m - DMat3(1.0);
    for (int i = 0; i < 3; ++i) REQUIRE(glm::length(defect[i]) < 1e-15);
    REQUIRE(glm::determinant(m) == Approx(1));
    REQUIRE(glm::dot(m[2], d) == Approx(glm::length(d)));
  }
}

TEST_CASE("Regions are closed sets") {
  const Region obb = Obb{{1, 2, 3}, DMat3(1.0), {1, 2, 3}};
  CHECK(contains(obb, Vec3(2, 4, 6)));
  CHECK(contains(obb, Vec3(0, 0, 0)));
  CHECK_FALSE(contains(obb, Vec3(std::nextafterf(2, 3), 4, 6)));
  CHECK_FALSE(contains(obb, Vec3(1, 2, std::nextafterf(6, 7))));

  const Region frustum = Frustum{{0, 0, 0}, DMat3(1.0), {1, 0.5}, 0, 8};
  CHECK(contains(frustum, Vec3(0)));
  CHECK(contains(frustum, Vec3(4, 2, 4)));
  CHECK(contains(frustum, Vec3(-8, 4, 8)));
  CHECK_FALSE(contains(frustum, Vec3(std::nextafterf(4, 5), 2, 4)));
  CHECK_FALSE(contains(frustum, Vec3(4, std::nextafterf(2, 3), 4)));
  CHECK_FALSE(contains(frustum, Vec3(0, 0, -1)));
  CHECK_FALSE(contains(frustum, Vec3(-1, 0, -1)));
  CHECK_FALSE(contains(frustum, Vec3(0, 0, std::nextafterf(8, 9))));

  const Region box = Aabb{{0, 0, 0}, {1, 1, 0}};
  CHECK(contains(box, Vec3(1, 1, 0)));
  CHECK_FALSE(contains(box, Vec3(1, 1, 1e-30F)));
  CHECK_FALSE(contains(Region(Aabb{}), Vec3(0)));
}

TEST_CASE("A region contains a box if it contains its corners") {
  const Region frustum = Frustum{{0, 0, 0}, DMat3(1.0), {1, 1}, 0, 8};
  CHECK(contains(frustum, Aabb{{-4, -4, 4}, {4, 4, 8}}));
  CHECK_FALSE(contains(frustum, Aabb{{-4, -4, 3.9F}, {4, 4, 8}}));
  CHECK_FALSE(contains(frustum, Aabb{{-4, -4, 4}, {4, 4, 8.1F}}));
  CHECK(contains(frustum, Aabb{}));
}

TEST_CASE("The enclosing box is tight and rounded outwards") {
  const Aabb box = enclosing_box(pyramid({0, 0, -1}, 2));
  for (int k = 0; k < 3; ++k) {
    CHECK(box.min[k] <= -2);
    CHECK(box.min[k] > -2.00001F);
  }
  CHECK(box.max.z >= 0);
  CHECK(box.max.z < 1e-6F);
  const Aabb turned =
      enclosing_box(Obb{DVec3(1e6), DMat3(orthonormal_basis(DVec3(1, 1, 1))), DVec3(1e-3)});
  CHECK(turned.min.x < 1e6F);
  CHECK(turned.max.x > 1e6F);
}

// Thesis, 3.2: "at least one of its vertices or edges is inside".
TEST_CASE("A thin region that pierces a large triangle overlaps it") {
  const Triangle large{{-100, 0, -100}, {100, 0, -100}, {0, 0, 100}};
  const Region thin = Obb{{0, 0, 0}, DMat3(1.0), {0.01, 5, 0.01}};
  const auto printed_overlaps = [&] {  // vertices; edges sampled densely
    for (int i = 0; i <= 100000; ++i) {
      const float t = static_cast<float>(i) / 100000;
      for (const auto& [p, q] :
           {std::pair{large.a, large.b}, {large.b, large.c}, {large.c, large.a}})
        if (contains(thin, p + t * (q - p))) return true;
    }
    return false;
  };
  CHECK_FALSE(printed_overlaps());
  CHECK(overlaps(thin, large));
  CHECK(overlaps(Region(Frustum{{0, 5, 0}, orthonormal_basis({0, -1, 0}), DVec2(0.001), 0, 9}),
                 large));
  CHECK_FALSE(overlaps(Region(Obb{{0, 6, 0}, DMat3(1.0), {0.01, 5, 0.01}}), large));
}

TEST_CASE("Touching counts as overlap, a gap does not") {
  const Region frustum = Frustum{{0, 0, 0}, DMat3(1.0), {1, 1}, 0, 8};
  CHECK(overlaps(frustum, Aabb{{-1, -1, -1}, {1, 1, 0}}));  // a face on the apex
  CHECK(overlaps(frustum, Aabb{{-1, -1, 8}, {1, 1, 9}}));   // on the far face
  CHECK(overlaps(frustum, Aabb{{4, -1, 0}, {5, 1, 4}}));    // edge on a side face
  CHECK_FALSE(overlaps(frustum, Aabb{{4.00001F, -1, 0}, {5, 1, 4}}));
  CHECK_FALSE(overlaps(frustum, Aabb{{-1, -1, -1}, {1, 1, -1e-6F}}));
  CHECK_FALSE(overlaps(frustum, Aabb{}));
  const Region turned = Obb{{0, 0, 0}, orthonormal_basis(DVec3(1, 1, 0)), {1, 1, 1}};
  CHECK(overlaps(turned, Triangle{{3, 0, 0}, {0, 3, 0}, {0.7F, 0.7F, 0}}));
  CHECK_FALSE(overlaps(turned, Triangle{{3, 0, 0}, {0, 3, 0}, {1, 1, 0}}));
  CHECK(overlaps(turned, Triangle{{0.1F, 0, 0}, {0.1F, 0, 0}, {0.1F, 0, 0}}));  // a point
  CHECK(overlaps(turned, Triangle{{-9, 0, 0}, {9, 0, 0}, {0, 0, 0}}));          // a segment
  CHECK_FALSE(overlaps(turned, Triangle{{-9, 0, 9}, {9, 0, 9}, {0, 0, 9}}));
}

TEST_CASE("The exit distance is at most a rounding short of where the ray leaves the region") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::exp2(static_cast<int>(random() % 40) - 20);
    const DVec3 offset =
        (i % 3 == 0 ? 1e3 : 1) * scale * DVec3(uniform(random), 0.5, uniform(random));
    const DMat3 axes = orthonormal_basis(DVec3(uniform(random), uniform(random), uniform(random)));
    const Region regions[] = {
        Obb{offset, axes, scale * DVec3(1, 0.5, 0.01)},
        Frustum{offset, axes, {1.5 + uniform(random), 0.7}, i % 2 == 0 ? 0 : 0.1 * scale, scale},
        Aabb{Vec3(offset), Vec3(offset + scale)}};
    for (const Region& region : regions) {
      Ray ray;
      ray.origin = Vec3(offset + scale * (axes * DVec3(0.2 * uniform(random), 0.2 * uniform(random),
                                                       0.5 + 0.5 * uniform(random))));
      ray.direction = Vec3(uniform(random), uniform(random), i % 5 == 0 ? 0 : uniform(random));
      const float t = exit_distance(region, ray);
      if (!contains(region, ray.origin)) {
        REQUIRE(t == 0);
        continue;
      }
      ++inside;
      REQUIRE(t >= 0);
      REQUIRE(t < inf);
      // The point at t, rounded to float: its float neighborhood touches the region; that of a
      // point slightly further does not.
      const auto at = [&](double s) { return DVec3(ray.origin) + s * DVec3(ray.direction); };
      const auto point = [&](double s) {
        const Vec3 p(at(s));
        const Vec3 r = glm::abs(p) * 1e-7F;
        return Aabb{p - r, p + r};
      };
      REQUIRE(overlaps(region, point(t)));
      REQUIRE(overlaps(region, point(0.5 * t)));
      const double reach = glm::length(offset) + 3 * scale;
      const double beyond = t * 1.0001 + 1e-4 * reach / glm::length(DVec3(ray.direction));
      REQUIRE_FALSE(contains(region, Vec3(at(beyond))));
    }
  }
  CHECK(inside > 5000);
  Ray axis;
  axis.origin = {0.5F, 0.5F, 0.5F};
  axis.direction = {0, 0, 2};
  CHECK(exit_distance(Aabb{{0, 0, 0}, {1, 1, 1}}, axis) <= 0.25F);
  CHECK(exit_distance(Aabb{{0, 0, 0}, {1, 1, 1}}, axis) > 0.249999F);
  axis.origin.z = 1;  // on the face, leaving
  CHECK(exit_distance(Aabb{{0, 0, 0}, {1, 1, 1}}, axis) == 0);
}

// overlaps() covers every point that contains() and exit_distance() allow.
TEST_CASE("The predicates agree about points within rounding error of the border") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int borderline = 0;
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::exp2(static_cast<int>(random() % 40) - 20);
    const DMat3 axes = orthonormal_basis(DVec3(uniform(random), uniform(random), uniform(random)));
    const double t = std::tan(0.5 * pi * (0.001 + 0.998 * std::abs(uniform(random))));
    const Region regions[] = {Obb{scale * axes[0], axes, scale * DVec3(1, 0.5, 0.01)},
                              Frustum{scale * axes[0], axes, {t, 0.7}, 0.5 * scale, scale}};
    for (const Region& region : regions) {
      const RegionShape shape = shape_of(region);
      // A float point next to a corner.
      const Vec3 p(shape.origin + shape.vertices[random() % 8]);
      if (!contains(region, p)) continue;
      ++borderline;
      REQUIRE(overlaps(shape, Aabb{p, p}));
      REQUIRE(overlaps(shape, Triangle{p, p, p}));
    }
  }
  CHECK(borderline > 1000);
}

TEST_CASE("A dilated shape extends every face by the dilation") {
  const Region regions[] = {Aabb{{-1, -1, 0}, {1, 1, 1}}, Obb{{0, 0, 0.5}, DMat3(1.0), {1, 1, 0.5}},
                            Frustum{{0, 0, 0}, DMat3(1.0), {1, 1}, 0, 1}};
  for (const Region& region : regions) {
    for (const auto& [point, distance] :
         {std::pair{Vec3(0, 0, 1.25F), 0.25}, {Vec3(0.5F, 0.5F, 1.25F), 0.25}}) {
      const Triangle t{point, point, point};
      CHECK_FALSE(overlaps(shape_of(region), t));
      CHECK_FALSE(overlaps(shape_of(region, 0.99 * distance), t));
      CHECK(overlaps(shape_of(region, distance), t));
    }
  }
  const Vec3 aside(1, 0, 0.5F);  // sqrt(1/8) from the side of the pyramid
  const Triangle t{aside, aside, aside};
  CHECK_FALSE(overlaps(shape_of(regions[2], 0.3535), t));
  CHECK(overlaps(shape_of(regions[2], 0.3536), t));
  const Triangle behind{{0, 0, -0.25F}, {0, 0, -0.25F}, {0, 0, -0.25F}};
  CHECK_FALSE(overlaps(shape_of(regions[2], 0.24), behind));
  CHECK(overlaps(shape_of(regions[2], 0.25), behind));
  CHECK(shape_of(Aabb{}).box.empty());
}
