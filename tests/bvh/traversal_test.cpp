// Nodes are tested otherwise than triangles; they must never hide one.
#include <hwy/highway.h>

#include <cmath>

#include "bvh/build.hpp"
#include "catch.hpp"
#include "support/soups.hpp"

using namespace pah;

namespace {

// Small, flat or far from the origin, often.
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

// Past the corners, edges and sides of the padded box, where a rounding decides.
Ray grazing_ray(const Aabb& box, test::Random& random) {
  const auto on_box = [&](int axis) {
    const std::uint32_t which = random.below(3);
    return which == 0   ? box.min[axis]
           : which == 1 ? box.max[axis]
                        : random.uniform(box.min[axis], box.max[axis]);
  };
  Ray ray;
  Vec3 target;
  const float away = std::ldexp(1.0F, static_cast<int>(random.below(30)) - 15);
  for (int axis = 0; axis < 3; ++axis) {
    target[axis] = on_box(axis);
    ray.origin[axis] =
        random.below(4) == 0 ? target[axis] : target[axis] + away * random.uniform(-1, 1);
  }
  ray.direction = target - ray.origin;
  for (int axis = 0; axis < 3; ++axis) {
    if (random.below(8) == 0) ray.direction[axis] = random.below(2) == 0 ? 0.0F : -0.0F;
    if (random.below(8) == 0)
      ray.direction[axis] *= std::ldexp(1.0F, -static_cast<int>(random.below(60)));
  }
  return ray;
}

struct Outcome {
  std::uint64_t met = 0, missed = 0, hidden = 0;
};

Outcome trace_grazing_rays(std::uint32_t triangles) {
  test::Random random(31);
  Outcome outcome;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Triangle triangle = random_triangle(random);
    test::Soup soup;
    soup.add(triangle.a, triangle.b, triangle.c);
    const Bvh bvh = build_bvh(soup.triangles()).bvh;
    const Aabb box = padded(triangle.bounds());
    for (int k = 0; k < 200; ++k) {
      const Ray ray = grazing_ray(box, random);
      const PreparedRay prepared = prepare(ray);
      const SlabInterval interval = intersect_box(prepared, box);
      const bool meets = interval.near <= std::min(interval.far, prepared.t_max);
      Hit hit;
      TraversalCounts counts;
      closest_hits(bvh, {&ray, 1}, {&hit, 1}, &counts);
      ++(meets ? outcome.met : outcome.missed);
      if (meets && counts.triangles == 0) ++outcome.hidden;
    }
  }
  return outcome;
}

}  // namespace

TEST_CASE("No node hides a triangle whose own box a ray meets, on any instruction set") {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    INFO(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const Outcome outcome = trace_grazing_rays(10000);
    CHECK(outcome.met > 100000);
    CHECK(outcome.missed > 100000);
    CHECK(outcome.hidden == 0);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}
