// Compares the kernels, which test boxes first and four triangles at a time, with the scalar rule.
#include <hwy/highway.h>

#include <cmath>

#include "bvh/build.hpp"
#include "catch.hpp"
#include "geometry/ray_triangle.hpp"
#include "support/soups.hpp"

using namespace pah;

namespace {

// Often small, flat or far from the origin.
Triangle random_triangle(test::Random& random) {
  const Aabb unit{Vec3{-1}, Vec3{1}};
  const float size = std::ldexp(1.0F, -static_cast<int>(random.below(20)));
  const Vec3 center =
      std::ldexp(1.0F, static_cast<int>(random.below(30)) - 10) * random.in_box(unit);
  Triangle triangle{center + size * random.in_box(unit), center + size * random.in_box(unit),
                    center + size * random.in_box(unit)};
  if (random.below(3) == 0) {
    const auto axis = static_cast<int>(random.below(3));
    triangle.b[axis] = triangle.c[axis] = triangle.a[axis];
  }
  return triangle;
}

// A corner, or a point on an edge or inside, up to float rounding.
Vec3 point_of(const Triangle& triangle, test::Random& random) {
  const float f = random.below(2) == 0 ? 0.0F : random.uniform(0, 1);
  const float g = random.below(2) == 0 ? 0.0F : random.uniform(0, 1 - f);
  return triangle.a + f * (triangle.b - triangle.a) + g * (triangle.c - triangle.a);
}

// Rays for which rounding decides: at edges and corners, in the triangle's plane, along axes.
Ray grazing_ray(const Triangle& triangle, test::Random& random) {
  const Vec3 target = point_of(triangle, random);
  const float away = std::ldexp(1.0F, static_cast<int>(random.below(30)) - 15);
  Vec3 origin = target;
  if (random.below(2) == 0) {
    origin += away * random.in_box({Vec3{-1}, Vec3{1}});
  } else {
    const Vec3 along = point_of(triangle, random) - point_of(triangle, random);
    origin -= random.uniform(0, 4) * along + 1e-6F * random.in_box({Vec3{-1}, Vec3{1}});
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (random.below(4) == 0) origin[axis] = target[axis];
  }
  Ray ray{origin, 1e30F, target - origin, no_bundle};
  for (int axis = 0; axis < 3; ++axis) {
    if (random.below(8) == 0) ray.direction[axis] = random.below(2) == 0 ? 0.0F : -0.0F;
    if (random.below(8) == 0)
      ray.direction[axis] *= std::ldexp(1.0F, -static_cast<int>(random.below(60)));
  }
  return ray;
}

struct Outcome {
  std::uint64_t met = 0, missed = 0, different = 0;
};

Outcome trace_grazing_rays(std::uint32_t triangles) {
  test::Random random(31);
  Outcome outcome;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Triangle triangle = random_triangle(random);
    test::Soup soup;
    soup.add(triangle.a, triangle.b, triangle.c);
    const Bvh bvh = build_bvh(soup.triangles()).bvh;
    for (int k = 0; k < 200; ++k) {
      const Ray ray = grazing_ray(triangle, random);
      TriangleHit expected;
      const bool meets = intersect_triangle(prepare(ray), triangle, ray.t_max, expected);
      Hit hit;
      closest_hits(bvh, {&ray, 1}, {&hit, 1}, nullptr);
      std::uint8_t any = 0;
      occluded(bvh, {&ray, 1}, {&any, 1}, nullptr);
      ++(meets ? outcome.met : outcome.missed);
      const bool same =
          meets == hit.valid() && meets == (any != 0) &&
          (!meets || (hit.t == expected.t && hit.u == expected.u && hit.v == expected.v));
      outcome.different += same ? 0 : 1;
    }
  }
  return outcome;
}

}  // namespace

TEST_CASE("A BVH answers like the scalar rule to the last bit on every instruction set") {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    INFO(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const Outcome outcome = trace_grazing_rays(10000);
    CHECK(outcome.met > 100000);
    CHECK(outcome.missed > 100000);
    CHECK(outcome.different == 0);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}
