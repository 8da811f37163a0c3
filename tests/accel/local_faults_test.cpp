// Tests the guards of local BVHs, with one area per case so that no other area answers in its
// place.
#include <cmath>
#include <pah/accel/local_bvhs.hpp>
#include <pah/bvh/analyze.hpp>
#include <pah/influence/bundle_area.hpp>

#include "accel/local/build_local.hpp"
#include "accel/local/bundle_heuristic.hpp"
#include "catch.hpp"
#include "support/answers.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

namespace {

constexpr std::uint32_t lamp = 7;
constexpr float endless = std::numeric_limits<float>::infinity();

// A square across the z axis.
void add_wall(Soup& soup, float z, float half) {
  soup.add({-half, -half, z}, {half, -half, z}, {half, half, z});
  soup.add({-half, -half, z}, {half, half, z}, {-half, half, z});
}

LocalBvhUse use_of(const Soup& soup, const InfluenceArea& area, const std::vector<Ray>& rays) {
  const auto local = make_local_bvhs(soup.triangles(), {{area, lamp}});
  TraversalCounts counts;
  check_same(ask(*make_brute_force(soup.triangles()), rays), ask(*local, rays, &counts));
  // Each ray counts twice: for the nearest hit and for occlusion.
  LocalBvhUse use = local->uses().at(0);
  CHECK(use.asked % 2 == 0);
  return {use.asked / 2, use.answered / 2, use.cost};
}

}  // namespace

TEST_CASE("What stands between an area's near plane and its eye stops segments to the eye") {
  const InfluenceArea area =
      make_point_area(DVec3(0), DVec3(0, 0, 1), DVec2(1.2), /*near=*/1, /*far=*/10);
  Soup soup;
  add_wall(soup, 0.5F, 1);  // before the near plane
  add_wall(soup, 9, 0.01F);
  REQUIRE(local_triangles(soup.triangles(), area).subset.size() == 2);
  std::vector<Ray> rays;
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 from{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(4, 8)};
    rays.push_back({from, 1, -from, lamp});
  }
  const Answers expected = ask(*make_brute_force(soup.triangles()), rays);
  CHECK(expected.occluded[0] == 1);
  CHECK(use_of(soup, area, rays).answered == 0);
}

TEST_CASE("What stands behind an area's side stops segments that end there") {
  const InfluenceArea area =
      make_point_area(DVec3(0), DVec3(0, 0, 1), DVec2(1), /*near=*/0, /*far=*/10);
  Soup soup;
  add_wall(soup, 12, 20);
  add_wall(soup, 5, 0.5F);
  REQUIRE(local_triangles(soup.triangles(), area).subset.size() == 2);
  std::vector<Ray> rays;
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3 from{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(6, 9)};
    const Vec3 to{random.uniform(-9, 9), random.uniform(-9, 9), 14};
    rays.push_back({from, 1, to - from, lamp});  // t_max is 1, as for segments to the eye
    rays.push_back({from, 1, -from, lamp});
  }
  const LocalBvhUse use = use_of(soup, area, rays);
  CHECK(use.asked == 400);
  CHECK(use.answered == 200);
}

TEST_CASE("A segment that misses the eye by a rounding meets what stands there") {
  // Floats are 2^-13 apart here, and the eye lies between them.
  const DVec3 eye(1000.00003, 1000.00004, 1000.00002);
  const InfluenceArea area =
      make_point_area(eye, DVec3(0, 0, 1), DVec2(0.5), /*near=*/0, /*far=*/50);
  const Vec3 rounded(eye);
  REQUIRE(rounded.x < eye.x);
  REQUIRE(rounded.y > eye.y);
  Soup soup;
  Random random(3);
  // Within a few floats of the eye, on the side from which segments arrive.
  const auto beside = [&] {
    Vec3 at = rounded;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] += std::ldexp(static_cast<float>(random.below(9)) - 4, -14);
    return Vec3(std::min(at.x, rounded.x), std::max(at.y, rounded.y), at.z);
  };
  for (int i = 0; i < 300; ++i) soup.add(beside(), beside(), beside());
  std::vector<Ray> rays;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 from =
        Vec3(1000) + Vec3(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(20, 40));
    rays.push_back({from, 1, rounded - from, lamp});
  }
  CHECK(use_of(soup, area, rays).answered > 2000);
}

TEST_CASE("A ray without a final answer from its area is not counted as answered") {
  const InfluenceArea area = make_plane_area(DVec3(0), DVec3(0, 0, 1), DVec2(2), /*depth=*/10);
  Soup soup;
  add_wall(soup, 5, 0.5F);
  add_wall(soup, 20, 9);
  const std::vector<Ray> rays{
      {{0, 0, 1}, endless, {0, 0, 1}, lamp},     // hits inside
      {{0.8F, 0, 1}, endless, {0, 0, 1}, lamp},  // hits behind the area
      {{0.8F, 0, 1}, 4, {0, 0, 1}, lamp},        // ends inside
      {{3, 0, 1}, endless, {0, 0, 1}, lamp},     // starts outside: not traced locally
      {{0, 0, 1}, endless, {0, 0, 1}, 8},        // of another bundle: not traced locally
  };
  const LocalBvhUse use = use_of(soup, area, rays);
  CHECK(use.asked == 3);
  CHECK(use.answered == 2);
  CHECK(use.cost > 0);
}

TEST_CASE("A tree built by PAH is cheaper for its bundle than one built by SAH") {
  // Sheets along the rays, of a large surface area that the bundle hardly sees, and sheets across
  // the rays.
  Soup soup;
  Random random(4);
  for (int i = 0; i < 4000; ++i) {
    const Vec3 at = random.in_box({Vec3(-1, -1, 1), Vec3(1, 1, 9)});
    const float width = 0.02F;
    const float length = random.uniform(0.1F, 3);
    soup.add(at, at + Vec3(width, 0, 0), at + Vec3(0, width, length));
  }
  const InfluenceArea area = make_plane_area(DVec3(0), DVec3(0, 0, 1), DVec2(3), 15);
  const HitProbability probability(area);
  const auto cost_by = [&](Heuristic heuristic) {
    LocalConfig config;
    config.heuristic = heuristic;
    const BuiltLocalBvh local = build_local_bvh(soup.triangles(), area, config);
    return expected_cost(local.built.tree, config.build, each_box(probability));
  };
  CHECK(cost_by(Heuristic::projected_area) < 0.8 * cost_by(Heuristic::surface_area));
}

TEST_CASE("Axes are rated by how well they face the bundle") {
  LocalConfig config;
  config.split = SplitAxis::facing;
  const Aabb box{{-1, -1, 3}, {1, 1, 5}};
  const auto rated = [&](const DVec3& direction, const Aabb& of) {
    const auto heuristic =
        bundle_heuristic(make_plane_area(DVec3(0), direction, DVec2(9), 9), config);
    REQUIRE(heuristic.search);
    return heuristic.search->rate(of);
  };
  const auto check = [&](const std::array<RatedAxis, 3>& axes, const std::array<int, 3>& order,
                         const std::array<double, 3>& qualities) {
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(axes[i].axis == order[i]);
      CHECK(axes[i].quality == Approx(qualities[i]).margin(1e-12));
    }
  };
  check(rated({0, 0, 1}, box), {0, 1, 2}, {1, 1, 0});
  check(rated({0, 1, 0}, box), {0, 2, 1}, {1, 1, 0});
  check(rated({0.6, 0.8, 0}, box), {2, 0, 1}, {1, 1 - 0.6 / 1.4, 1 - 0.8 / 1.4});
  // An axis without extent cannot be split.
  check(rated({0, 0, 1}, {{0, -1, 3}, {0, 1, 5}}), {1, 2, 0}, {1, 0, -1});
}

TEST_CASE("The nearest of many walls is found in a few nodes") {
  Soup soup;
  for (int i = 0; i < 1000; ++i) add_wall(soup, static_cast<float>(i), 1);
  std::vector<Ray> rays;
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const bool forth = i % 2 == 0;
    const Vec3 from{random.uniform(-0.9F, 0.9F), random.uniform(-0.9F, 0.9F),
                    forth ? -1.0F : 1001.0F};
    rays.push_back({from, endless, {0, 0, forth ? 1.0F : -1.0F}});
  }
  std::vector<Hit> hits(rays.size());
  TraversalCounts counts;
  make_global_bvh(soup.triangles())->closest_hit(rays, hits, &counts);
  for (const Hit& hit : hits)
    CHECK((std::abs(hit.t - 1) < 1e-3F ||
           std::abs(hit.t - 2) < 1e-3F));  // the first wall, or the last
  // Seven inner levels and a leaf or two, not the 250 nodes and more that all the walls take.
  CHECK(counts.nodes < 20 * rays.size());
  CHECK(counts.triangles < 40 * rays.size());
}

TEST_CASE("Nodes behind the nearest hit are not visited, even if rays miss nearer boxes") {
  Soup soup;
  for (int i = 0; i < 1000; ++i) {
    const auto z = static_cast<float>(i);
    if (i == 300)
      add_wall(soup, z, 1);
    else
      soup.add({-1, -1, z}, {1, -1, z}, {-1, 1, z});  // half a wall, with the box of a whole one
  }
  const auto bvh = make_global_bvh(soup.triangles());
  const auto counts_of = [&](float t_max) {
    std::vector<Ray> rays;
    Random random(6);
    for (int i = 0; i < 100; ++i)
      rays.push_back(
          {{random.uniform(0.1F, 0.9F), random.uniform(0.1F, 0.9F), -1}, t_max, {0, 0, 1}});
    std::vector<Hit> hits(rays.size());
    TraversalCounts counts;
    bvh->closest_hit(rays, hits, &counts);
    for (const Hit& hit : hits) CHECK(std::abs(hit.t - 301) < 1e-3F);
    return counts;
  };
  const TraversalCounts free = counts_of(endless);
  const TraversalCounts bounded = counts_of(301.5F);
  CHECK(free.nodes < 1.05 * static_cast<double>(bounded.nodes));
  CHECK(free.triangles < 1.05 * static_cast<double>(bounded.triangles));
}
