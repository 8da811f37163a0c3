// Tests that a look-up in a light grid changes no answer.

#include <pah/accel/light_grids.hpp>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "catch.hpp"
#include "support/answers.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

namespace {

constexpr std::uint32_t bundle = 7;
constexpr float infinity = std::numeric_limits<float>::infinity();

// A box with room around the scene, where rays may start.
Soup with_room(Soup soup, float size) {
  for (const float s : {-size, size}) soup.add({s, s, s}, {s, s, s * 0.99F}, {s, s * 0.99F, s});
  return soup;
}

Ray to_light(const PointBundle& light, const Vec3& from, Random& random) {
  const float t_max = random.below(4) == 0 ? random.uniform(0, 1) : 1 - 0x1p-20F;
  return {from, t_max, light.eye - from, bundle};
}
Ray to_light(const ParallelBundle& light, const Vec3& from, Random& random) {
  Vec3 toward = light.toward;
  if (light.tangent > 0) {
    // Half of the rays are tilted by the largest allowed angle.
    const Vec3 across = glm::cross(toward, random.in_box({Vec3{-1}, Vec3{1}}));
    const float share = random.below(2) == 0 ? 1 : random.uniform(0, 1);
    toward += share * light.tangent * across / std::max(glm::length(across), 0x1p-10F);
    // Some are tilted further: these traverse the BVH.
    if (light.tangent >= 0.1F && random.below(8) == 0)
      toward[static_cast<int>(random.below(3))] = 0;
    toward *= random.uniform(0.5F, 2);
  }
  return {from, random.below(4) == 0 ? random.uniform(0, 3) : infinity, toward, bundle};
}
Vec3 away_from(const PointBundle& light, const Vec3& at) { return at - light.eye; }
Vec3 away_from(const ParallelBundle& light, const Vec3& /*at*/) { return -light.toward; }

// Rays that start on triangles, slightly off them, behind them, or anywhere.
template <typename Bundle>
std::vector<Ray> rays_to(const Bundle& light, const Soup& soup, std::uint32_t count,
                         std::uint32_t seed) {
  Random random(seed);
  const Triangles triangles = soup.triangles();
  const Aabb box = bounds_of(triangles);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Triangle t = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
    const Vec3 at = point_on(t, random);
    const Vec3 away = away_from(light, at);
    Vec3 from = at;
    switch (random.below(5)) {
      case 0:
        break;
      case 1:
        from = at + 0x1p-22F * random.in_box({Vec3{-1}, Vec3{1}});
        break;
      case 2:
        from = at + random.uniform(0, 1) * away;
        break;
      case 3:
        from = at + std::exp2(random.uniform(-24, 0)) * away;
        break;
      default:
        from = random.in_box(box);
        break;
    }
    rays.push_back(to_light(light, from, random));
  }
  return rays;
}

struct Setup {
  Soup soup;
  std::unique_ptr<Accelerator> brute_force = make_brute_force(soup.triangles());

  explicit Setup(Soup of) : soup(std::move(of)) {}

  template <typename Bundle>
  void check(const Bundle& light, std::uint32_t count, std::uint32_t seed) const {
    INFO(soup.name);
    const std::vector<Ray> rays = rays_to(light, soup, count, seed);
    const auto grids = make_light_grids(soup.triangles(), {{bundle, light}});
    const Answers expected = ask(*brute_force, rays);
    check_same(expected, ask(*grids, rays));
    TraversalCounts counts;
    check_same(expected, ask(*grids, rays, &counts));
  }
};

}  // namespace

TEST_CASE("A light grid answers like brute force, bit for bit") {
  Random random(5);
  for (const Soup& soup : all_soups()) {
    if (soup.indices.empty()) continue;
    const Setup setup(with_room(soup, 3));
    for (std::uint32_t round = 0; round < 3; ++round) {
      const Vec3 eye = random.in_box({Vec3{-2}, Vec3{2}});
      setup.check(PointBundle{eye}, 3000, round);
      setup.check(PointBundle{100.0F * eye}, 1000, round);
      setup.check(PointBundle{eye, glm::normalize(-eye), 0.3F}, 3000, round);
      setup.check(ParallelBundle{glm::normalize(eye)}, 3000, round);
      for (const float tangent : {1e-6F, 0.005F, 0.1F, 1.0F})
        setup.check(ParallelBundle{glm::normalize(eye), tangent}, 2000, round);
    }
  }
}

TEST_CASE("Rays of a light's bundle are looked up and do not traverse") {
  Random random(3);
  const Setup setup(with_room(grid(60, 0.3F, 4), 2));
  const auto share_looked_up = [&](const auto& light) {
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < 2000; ++i)
      rays.push_back(to_light(light, point_on(setup.soup.triangles()[i], random), random));
    const auto grids = make_light_grids(setup.soup.triangles(), {{bundle, light}});
    std::vector<std::uint8_t> occluded(rays.size());
    TraversalCounts counts;
    grids->occluded(rays, occluded, &counts);
    // Only traversals visit inner nodes.
    return 1 - static_cast<double>(counts.inner_nodes) / static_cast<double>(rays.size());
  };
  CHECK(share_looked_up(PointBundle{{0.5F, 1.5F, 0.25F}}) == 1);
  CHECK(share_looked_up(ParallelBundle{glm::normalize(Vec3{1, 2, 3})}) == 1);
  CHECK(share_looked_up(ParallelBundle{glm::normalize(Vec3{1, 2, 3}), 0.005F}) == 1);
  // Rays from outside the cone traverse.
  CHECK(share_looked_up(PointBundle{{30, 40, 30}, {0, -1, 0}, 0.95F}) == 1);
  CHECK(share_looked_up(PointBundle{{30, 40, 30}, {0, -1, 0}, 0.1F}) < 0);
}

TEST_CASE("A light grid does not depend on the number of threads", "[threads]") {
  const Soup soup = with_room(random_soup(20'000, 0.02F, Vec3{0}, 14), 1.5F);
  const PointBundle light{{0.5F, 1.25F, 0.25F}};
  const std::vector<Ray> rays = rays_to(light, soup, 4000, 15);
  std::uint64_t bytes = 0;
  std::vector<std::uint8_t> expected;
  for (const int threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] {
      const auto grids = make_light_grids(soup.triangles(), {{bundle, light}});
      std::vector<std::uint8_t> occluded(rays.size());
      grids->occluded(rays, occluded);
      if (threads == 1) {
        bytes = grids->reports()[0].bytes;
        expected = occluded;
      }
      CHECK(grids->reports()[0].bytes == bytes);
      CHECK(occluded == expected);
    });
  }
}

TEST_CASE("A light grid on a surface, an edge or a vertex answers like brute force") {
  Random random(6);
  for (const Soup& soup :
       {grid(40, 0.2F, 1), grid(40, 0, 2), random_soup(2000, 0.1F, Vec3{0}, 3)}) {
    const Setup setup(with_room(soup, 2));
    for (std::uint32_t round = 0; round < 6; ++round) {
      const Triangle t = setup.soup.triangles()[random.below(2000)];
      setup.check(PointBundle{point_on(t, random)}, 2000, round);
    }
    for (const Vec3& toward : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, -1}}) {
      for (const float tangent : {0.0F, 0.005F})
        setup.check(ParallelBundle{toward, tangent}, 2000, 9);
    }
    // Rays in the plane of a flat grid.
    setup.check(PointBundle{{1.5F, 0, 0.25F}}, 2000, 10);
    setup.check(ParallelBundle{glm::normalize(Vec3{1, 0, 0.5F})}, 2000, 11);
  }
}

TEST_CASE("Rays at the seams of the faces of a light's cube answer like brute force") {
  const Setup setup(with_room(random_soup(5000, 0.05F, Vec3{0}, 8), 2));
  const PointBundle light{{0.25F, 0.5F, -0.125F}};
  Random random(9);
  std::vector<Ray> rays;
  for (int i = 0; i < 20'000; ++i) {
    const float x = std::ldexp(static_cast<float>(random.below(1024)), -10);
    const float sign = random.below(2) == 0 ? 1.0F : -1.0F;
    Vec3 away{x, sign * x, random.uniform(-1, 1) * x};
    if (random.below(3) == 0) away.z = x;
    const int turn = static_cast<int>(random.below(3));
    away = {away[turn], away[(turn + 1) % 3], away[(turn + 2) % 3]};
    rays.push_back(to_light(light, light.eye + away, random));
  }
  check_same(ask(*setup.brute_force, rays),
             ask(*make_light_grids(setup.soup.triangles(), {{bundle, light}}), rays));
}

TEST_CASE("Rays that only claim to be of a light's bundle traverse") {
  const Setup setup(with_room(random_soup(3000, 0.1F, Vec3{0}, 4), 2));
  std::vector<Ray> rays = rays_for(setup.soup, 4000, 12);
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].bundle = i % 2 == 0 ? bundle : no_bundle;
  const Answers expected = ask(*setup.brute_force, rays);
  const std::vector<LightBundle> lights{{bundle, PointBundle{{0, 1, 0}}},
                                        {bundle + 1, ParallelBundle{{0, 1, 0}}}};
  check_same(expected, ask(*make_light_grids(setup.soup.triangles(), lights), rays));
}

TEST_CASE("A light grid stays small where large triangles overlap") {
  Soup soup{"cards", {}, {}};
  for (int i = 0; i < 4000; ++i) {
    const float z = static_cast<float>(i) * 0x1p-12F;
    soup.add({-1, -1, z}, {1, -1, z}, {0, 1, z});
  }
  const Setup setup(with_room(soup, 2));
  const PointBundle light{{0, 0, 1.5F}};
  setup.check(light, 500, 1);
  const auto grids = make_light_grids(setup.soup.triangles(),
                                      {{bundle, light}, {bundle + 1, ParallelBundle{{0, 0, 1}}}});
  for (const LightGridReport& report : grids->reports()) CHECK(report.bytes < 4000 * 500);
}

TEST_CASE("A light grid of few or degenerate triangles answers like brute force") {
  Soup nothing{"nothing", {}, {}};
  Soup point{"point", {}, {}};
  point.add(Vec3{1}, Vec3{1}, Vec3{1});
  Soup line{"line", {}, {}};
  line.add({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  Soup one{"one", {}, {}};
  one.add({-1, 0, -1}, {1, 0, -1}, {0, 0, 1});
  Soup huge{"huge", {}, {}};
  huge.add({-1e37F, 0, -1e37F}, {1e37F, 0, -1e37F}, {0, 0, 1e37F});
  for (const Soup& soup : {nothing, point, line, one, huge}) {
    const auto brute_force = make_brute_force(soup.triangles());
    INFO(soup.name);
    const std::vector<Ray> rays{{{0, -1, 0}, 1, {0, 3, 0}, bundle},
                                {{0.5F, 0, 0}, 1, {-0.5F, 2, 0}, bundle},
                                {{0, -1, 0}, infinity, {0, 1, 0}, bundle + 1}};
    const auto grids = make_light_grids(
        soup.triangles(),
        {{bundle, PointBundle{{0, 2, 0}}}, {bundle + 1, ParallelBundle{{0, 1, 0}}}});
    check_same(ask(*brute_force, rays), ask(*grids, rays));
  }
}
