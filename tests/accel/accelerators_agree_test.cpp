// Tests that accelerators agree to the last bit.

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "support/answers.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

TEST_CASE("A global BVH answers like brute force, bit for bit") {
  for (const Soup& soup : all_soups()) {
    INFO(soup.name);
    const std::vector<Ray> rays = rays_for(soup, 4000, 42);
    const auto brute_force = make_brute_force(soup.triangles());
    const auto bvh = make_global_bvh(soup.triangles());
    const Answers expected = ask(*brute_force, rays);
    check_same(expected, ask(*bvh, rays));

    TraversalCounts counts;
    check_same(expected, ask(*bvh, rays, &counts));
    CHECK((counts.nodes > 0 || soup.indices.empty()));
    if (soup.indices.size() > 1 && soup.name != "degenerate") {
      CHECK(std::count_if(expected.hits.begin(), expected.hits.end(),
                          [](const Hit& hit) { return hit.valid(); }) > 100);
    }
  }
}

TEST_CASE("Every instruction set gives the same answers") {
  const Soup soup = random_soup(3000, 0.2F, Vec3{0}, 10);
  const std::vector<Ray> rays = rays_for(soup, 4000, 43);
  const auto bvh = make_global_bvh(soup.triangles());
  const Answers expected = ask(*make_brute_force(soup.triangles()), rays);
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  CHECK_FALSE(targets.empty());
  for (const std::int64_t target : targets) {
    INFO(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    check_same(expected, ask(*bvh, rays));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST_CASE("A hit at t_max counts, and none beyond") {
  Soup soup{"plane", {{-9, 0, -9}, {9, 0, -9}, {0, 0, 9}}, {{0, 1, 2}}};
  std::vector<Ray> rays(2, Ray{{0, 2, 0}, 2, {0, -1, 0}});
  rays[1].t_max = std::nextafter(2.0F, 0.0F);
  for (auto* make : {&make_brute_force, &make_global_bvh}) {
    const Answers answers = ask(*make(soup.triangles()), rays);
    CHECK(answers.hits[0].t == 2);
    CHECK(answers.occluded[0] == 1);
    CHECK_FALSE(answers.hits[1].valid());
    CHECK(answers.occluded[1] == 0);
  }
}

TEST_CASE("Ties go to the lower index") {
  Soup soup{"identical", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
  soup.indices.assign(100, UVec3{0, 1, 2});
  const std::vector<Ray> rays{{{0.25F, 0.25F, 1}, 10, {0, 0, -1}}};
  CHECK(ask(*make_brute_force(soup.triangles()), rays).hits[0].triangle == 0);
  CHECK(ask(*make_global_bvh(soup.triangles()), rays).hits[0].triangle == 0);
}

TEST_CASE("Invalid rays hit nothing") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const Soup soup = random_soup(100, 1.0F, Vec3{0}, 1);
  std::vector<Ray> rays(6);
  rays[0].direction = {0, 0, 0};
  rays[1].direction = {nan, 0, 1};
  rays[2].origin = {0, nan, 0};
  rays[3].t_max = nan;
  rays[4].direction = {0, 0, inf};
  rays[5].t_max = 0;
  for (auto* make : {&make_brute_force, &make_global_bvh}) {
    const Answers answers = ask(*make(soup.triangles()), rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      CHECK_FALSE(answers.hits[i].valid());
      CHECK(answers.occluded[i] == 0);
    }
  }
}

TEST_CASE("A distant triangle does not make rays near others more expensive") {
  Soup soup = random_soup(20'000, 0.02F, Vec3{0}, 12);
  const std::vector<Ray> rays = rays_for(random_soup(100, 0.2F, Vec3{0}, 13), 4000, 44);
  TraversalCounts alone;
  (void)ask(*make_global_bvh(soup.triangles()), rays, &alone);
  for (const float far : {1e7F, 1e12F}) {
    Soup with = soup;
    with.add({far, 0, 0}, {far, far, 0}, {far, 0, far});
    TraversalCounts counts;
    const Answers answers = ask(*make_global_bvh(with.triangles()), rays, &counts);
    CHECK(static_cast<double>(counts.nodes) < 1.2 * static_cast<double>(alone.nodes));
    CHECK(static_cast<double>(counts.triangles) < 1.2 * static_cast<double>(alone.triangles));
    check_same(ask(*make_brute_force(with.triangles()), rays), answers);
  }
}
