// Tests that rays cost what local BVHs predict.
#include <cmath>
#include <pah/accel/local_bvhs.hpp>

#include "catch.hpp"
#include "report/study/areas.hpp"
#include "report/study/rays.hpp"
#include "support/soups.hpp"

using namespace pah;

namespace {

constexpr std::uint32_t lamp = 0;

// Triangles without surface area: rays meet their boxes but never hit them, so no ray ends early.
test::Soup slivers(std::uint32_t count, float length) {
  test::Soup soup;
  test::Random random(11);
  const Aabb around{Vec3{-1}, Vec3{1}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 at = random.in_box(around);
    const Vec3 end = at + length * random.in_box(around);
    soup.add(at, end, end);
  }
  return soup;
}

// The bundle's rays, shortened slightly at both ends of the region.
std::vector<Ray> rays_within(const InfluenceArea& area, std::uint64_t count) {
  std::vector<Ray> rays;
  for (const BundleRay& drawn : draw_rays(area, count, 17)) {
    Ray ray = ray_of(drawn);
    ray.origin += 1e-5F * ray.t_max * ray.direction;
    ray.t_max *= 1 - 2e-5F;
    ray.bundle = lamp;
    rays.push_back(ray);
  }
  return rays;
}

struct Sample {
  double count = 0, sum = 0, squares = 0;

  void add(double value) {
    count += 1;
    sum += value;
    squares += value * value;
  }
  [[nodiscard]] double mean() const { return sum / count; }
  [[nodiscard]] double standard_error() const {
    return std::sqrt(std::max(0.0, squares / count - mean() * mean()) / (count - 1));
  }
};

void check_near(const Sample& measured, double predicted) {
  CAPTURE(measured.mean(), measured.standard_error(), predicted);
  CHECK(std::abs(measured.mean() - predicted) <
        4 * measured.standard_error() + 1e-4 * measured.mean());
}

// The study has no point area with a near plane.
std::vector<StudyArea> areas_within(const Aabb& bounds) {
  std::vector<StudyArea> areas = study_areas(bounds, false);
  areas.push_back(
      {"point, with a near plane", StudyGroup::point_outside,
       make_point_area({0, 3, 0}, {0, -1, 0.2}, DVec2(0.8, 0.5), 2.5, 4, PointMeasure::plane)});
  return areas;
}

}  // namespace

TEST_CASE("Rays that hit nothing cost what is predicted, within four standard errors") {
  const test::Soup soup = slivers(3000, 0.2F);
  for (const StudyArea& area : areas_within(bounds_of(soup.triangles()))) {
    CAPTURE(area.name);
    const std::vector<Ray> rays = rays_within(area.area, 20'000);
    for (const Heuristic heuristic : {Heuristic::surface_area, Heuristic::projected_area}) {
      CAPTURE(heuristic == Heuristic::projected_area);
      LocalConfig config;
      config.heuristic = heuristic;
      const auto local = make_local_bvhs(soup.triangles(), {{area.area, lamp}}, config);
      // Traced one by one, to get the cost of each ray.
      Sample own, global;
      LocalBvhUse before;
      TraversalCounts counts;
      for (const Ray& ray : rays) {
        std::uint8_t hit = 1;
        local->occluded(std::span(&ray, 1), std::span(&hit, 1), &counts);
        REQUIRE(hit == 0);
        const LocalBvhUse use = local->uses().front();
        if (use.asked > before.asked) own.add(use.cost - before.cost);
        if (use.sampled > before.sampled) global.add(use.global_cost - before.global_cost);
        before = use;
      }
      // All rays except those whose rounded origin is outside.
      CHECK(own.count > 19'500);
      CHECK(global.count > 200);
      check_near(own, local->reports().front().predicted_cost);
      check_near(global, local->reports().front().global_cost);
    }
  }
}

TEST_CASE("Rays that hit something cost less than is predicted") {
  const test::Soup soup = test::random_soup(3000, 0.2F, Vec3{0}, 12);
  for (const StudyArea& area : areas_within(bounds_of(soup.triangles()))) {
    CAPTURE(area.name);
    const std::vector<Ray> rays = rays_within(area.area, 20'000);
    const auto local = make_local_bvhs(soup.triangles(), {{area.area, lamp}});
    std::vector<Hit> hits(rays.size());
    TraversalCounts counts;
    local->closest_hit(rays, hits, &counts);
    const LocalBvhUse use = local->uses().front();
    const LocalBvhReport& report = local->reports().front();
    CHECK(use.cost / static_cast<double>(use.asked) < 0.9 * report.predicted_cost);
    CHECK(use.global_cost / static_cast<double>(use.sampled) < 0.9 * report.global_cost);
  }
}

TEST_CASE("What is measured depends neither on batches nor on threads' order") {
  const test::Soup soup = test::random_soup(3000, 0.2F, Vec3{0}, 12);
  const StudyArea area = study_areas(bounds_of(soup.triangles()), true).front();
  std::vector<Ray> rays = rays_within(area.area, 5'000);
  std::vector<LocalBvhUse> uses;
  for (const std::size_t batch : {1U, 7U, 5'000U}) {
    const auto local = make_local_bvhs(soup.triangles(), {{area.area, lamp}});
    std::vector<Hit> hits(rays.size());
    TraversalCounts counts;
    for (std::size_t first = 0; first < rays.size(); first += batch) {
      const std::size_t count = std::min(batch, rays.size() - first);
      local->closest_hit(std::span(rays).subspan(first, count), std::span(hits).first(count),
                         &counts);
    }
    uses.push_back(local->uses().front());
    std::reverse(rays.begin(), rays.end());
  }
  CHECK(uses[0].sampled > 0);
  for (const LocalBvhUse& use : uses) {
    CHECK(use.asked == uses[0].asked);
    CHECK(use.cost == uses[0].cost);
    CHECK(use.sampled == uses[0].sampled);
    CHECK(use.global_cost == uses[0].global_cost);
  }
}
