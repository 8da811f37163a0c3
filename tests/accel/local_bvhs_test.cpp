// Tests that local BVHs answer like brute force, whatever the areas.
#include <algorithm>
#include <array>
#include <pah/accel/local_bvhs.hpp>

#include "catch.hpp"
#include "support/answers.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

namespace {

constexpr std::uint32_t lamp = 0, sun = 1, stray = 2;

struct Setting {
  Vec3 eye;
  Vec3 sunlight;
  std::vector<LocalArea> areas;
  std::vector<Ray> rays;
};

// Areas that overlap, cut triangles, have a near plane, hold the eye, or belong to another light
// than their rays name; and the rays to trace.
Setting make_setting(const Soup& soup, std::uint32_t seed, std::size_t rays_each = 3000) {
  Random random(seed);
  Aabb box = bounds_of(soup.triangles());
  const Vec3 size = glm::max(box.extent(), Vec3(1e-3F * glm::length(box.extent())));
  const auto scale = static_cast<double>(std::max({size.x, size.y, size.z}));
  box = {box.center() - 0.75F * size, box.center() + 0.75F * size};

  Setting setting;
  setting.eye = random.in_box(box);
  setting.sunlight = glm::normalize(random.in_box({Vec3(-1), Vec3(1)}));
  const DVec3 eye(setting.eye);
  const DVec3 center(box.center());
  const DVec3 towards = center - eye;
  constexpr double right_angle = 1.5707963267948966;
  for (int k = 0; k < 3; ++k) {
    DVec3 axis(0);
    axis[k] = 1;
    for (const double side : {-1.0, 1.0}) {
      setting.areas.push_back(
          {make_point_area(eye, side * axis, DVec2(right_angle), 0, 0.8 * scale), lamp});
    }
  }
  setting.areas.push_back(
      {make_point_area(eye, towards, DVec2(0.9, 0.5), 0.1 * scale, 2 * scale), lamp});
  setting.areas.push_back({make_point_area(eye, towards, DVec2(0.4), 0, 9 * scale), camera_bundle});
  setting.areas.push_back(
      {make_plane_area(center - 0.4 * scale * DVec3(setting.sunlight), DVec3(setting.sunlight),
                       DVec2(0.5 * scale, scale), 0.8 * scale),
       sun});
  setting.areas.push_back({make_plane_area(center - 9.0 * scale * DVec3(setting.sunlight),
                                           DVec3(setting.sunlight), DVec2(9 * scale), 18 * scale),
                           sun});
  setting.areas.push_back(
      {make_plane_area(center, DVec3(0.3, -1, 0.2), DVec2(1e-6 * scale), 0.5 * scale), stray});

  const auto add = [&](const Vec3& origin, float t_max, const Vec3& direction,
                       std::uint32_t bundle) {
    setting.rays.push_back({origin, t_max, direction, bundle});
  };
  constexpr float far = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < rays_each; ++i) {
    const Vec3 point = random.in_box(box);
    add(point, 1, setting.eye - point, lamp);
    add(point, 0.9999F, setting.eye - point, lamp);
    add(point, far, setting.eye - point, lamp);
    add(setting.eye, far, point - setting.eye, camera_bundle);
    add(point, far, -setting.sunlight, sun);
    add(point, far, random.in_box({Vec3(-1), Vec3(1)}), sun);
    add(point, far, random.in_box({Vec3(-1), Vec3(1)}), stray);
    add(point, far, setting.eye - point, no_bundle);
  }
  return setting;
}

}  // namespace

TEST_CASE("Local BVHs answer like brute force, bit for bit") {
  std::uint32_t seed = 7;
  for (const Soup& soup : all_soups()) {
    if (soup.indices.empty()) continue;
    INFO(soup.name);
    const Setting setting = make_setting(soup, ++seed);
    const Answers expected = ask(*make_brute_force(soup.triangles()), setting.rays);
    for (const auto heuristic :
         {Heuristic::surface_area, Heuristic::projected_area, Heuristic::mean_direction}) {
      for (const auto split : {SplitAxis::best, SplitAxis::longest, SplitAxis::facing}) {
        LocalConfig config;
        config.heuristic = heuristic;
        config.split = split;
        const auto local = make_local_bvhs(soup.triangles(), setting.areas, config);
        check_same(expected, ask(*local, setting.rays));
      }
    }
  }
}

TEST_CASE("Local BVHs answer like brute force, 1e7 rays", "[full]") {
  std::uint32_t seed = 100;
  std::size_t rays = 0;
  while (rays < 10'000'000) {
    for (const Soup& soup : all_soups()) {
      if (soup.indices.empty()) continue;
      CAPTURE(soup.name, seed);
      const Setting setting = make_setting(soup, ++seed, 12'000);
      LocalConfig config;
      config.heuristic = seed % 2 == 0 ? Heuristic::surface_area : Heuristic::projected_area;
      config.split = std::array{SplitAxis::best, SplitAxis::longest, SplitAxis::facing}[seed % 3];
      const auto local = make_local_bvhs(soup.triangles(), setting.areas, config);
      check_same(ask(*make_brute_force(soup.triangles()), setting.rays), ask(*local, setting.rays));
      rays += setting.rays.size();
    }
  }
}

TEST_CASE("Local BVHs answer rays that would otherwise go to the global BVH", "[threads]") {
  const Soup soup = random_soup(3000, 0.05F, Vec3{0}, 10);
  const Setting setting = make_setting(soup, 3);
  const auto local = make_local_bvhs(soup.triangles(), setting.areas);
  REQUIRE(local->reports().size() == setting.areas.size());
  for (const LocalBvhReport& report : local->reports()) {
    CHECK(report.triangles <= soup.indices.size());
    CHECK(report.global_cost >= 0);
  }
  // The area that holds everything has every triangle, and costs as much as the global BVH.
  const LocalBvhReport& whole = local->reports()[setting.areas.size() - 2];
  CHECK(whole.triangles == soup.indices.size());
  CHECK(whole.predicted_cost == Approx(whole.global_cost));
  // The needle's area has almost no triangles.
  CHECK(local->reports().back().triangles < soup.indices.size() / 10);
}

TEST_CASE("Local BVHs work without triangles and without areas") {
  const Soup empty;
  const std::vector<Ray> rays(3);
  CHECK(!ask(*make_local_bvhs(empty.triangles(), {}), rays).hits[0].valid());
  const LocalArea area{make_point_area(DVec3(0), DVec3(0, -1, 0), DVec2(1), 0, 1), lamp};
  CHECK(!ask(*make_local_bvhs(empty.triangles(), {area}), rays).hits[0].valid());
}
