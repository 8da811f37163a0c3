// Tests that every kind of top level finds the areas that hold a point, and that rays without a
// bundle are answered like by brute force for every kind and tolerance.
#include "accel/local/top_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <pah/accel/local_bvhs.hpp>

#include "catch.hpp"
#include "support/answers.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

namespace {

std::vector<InfluenceArea> random_areas(std::size_t count, Random& random, const Aabb& box,
                                        double scale) {
  std::vector<InfluenceArea> areas;
  while (areas.size() < count) {
    const DVec3 at(random.in_box(box));
    const DVec3 direction(random.in_box({Vec3(-1), Vec3(1)}));
    const double size = scale * (0.02 + random.uniform(0, 1));
    if (areas.size() % 3 == 0)
      areas.emplace_back(make_plane_area(at, direction, DVec2(size, 0.5 * size), size));
    else if (areas.size() % 3 == 1)
      areas.emplace_back(
          make_point_area(at, direction, DVec2(0.3 + random.uniform(0, 1)), 0, size));
    else
      areas.emplace_back(make_plane_area(at, DVec3(0, -1, 0), DVec2(size), size));  // along an axis
  }
  return areas;
}

std::vector<Region> regions_of(const std::vector<InfluenceArea>& areas) {
  std::vector<Region> regions;
  for (const InfluenceArea& area : areas) regions.push_back(region_of(area));
  return regions;
}

std::vector<std::uint32_t> ascending(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
  return order;
}

template <typename Structure>
std::vector<AreaCandidate> all_at(const Structure& structure, const Vec3& point) {
  std::vector<AreaCandidate> found;
  structure.visit(point, [&](const AreaCandidate& candidate) {
    found.push_back(candidate);
    return false;
  });
  return found;
}

// Counts areas that hold the point and are missed, found twice or found out of order.
template <typename Structure>
int faults_at(const Structure& structure, const std::vector<Region>& regions, const Vec3& point) {
  const std::vector<AreaCandidate> found = all_at(structure, point);
  int faults = std::ranges::is_sorted(found, std::less_equal{}, &AreaCandidate::area) ? 0 : 1;
  for (std::uint32_t i = 0; i < regions.size(); ++i) {
    const bool named = std::ranges::find(found, i, &AreaCandidate::area) != found.end();
    if (contains(regions[i], point) && !named) ++faults;
  }
  return faults;
}

// Random points, often on borders of cells and areas or next to them.
Vec3 next_point(Random& random, const Aabb& box, const std::vector<Region>& regions) {
  Vec3 point = random.in_box(box);
  const std::uint32_t kind = random.below(10);
  if (kind < 3) {
    for (int k = 0; k < 3; ++k) {  // a border between cells
      const float cells = std::ldexp(1.0F, static_cast<int>(random.below(8)));
      const float share = std::round((point[k] - box.min[k]) / (box.max[k] - box.min[k]) * cells);
      if (random.below(2) == 0) point[k] = box.min[k] + share / cells * (box.max[k] - box.min[k]);
    }
  } else if (kind < 6) {
    const std::size_t i = random.below(static_cast<std::uint32_t>(regions.size()));
    const Aabb around = enclosing_box(regions[i]);
    const int k = static_cast<int>(random.below(3));
    point[k] = random.below(2) == 0 ? around.min[k] : around.max[k];
  }
  return point;
}

void check_points(std::size_t points, std::uint32_t seed) {
  for (const auto& [offset, scale] : {std::pair{0.0F, 1.0F}, {1000.0F, 1.0F}, {-3.0F, 1e-3F}}) {
    Random random(seed);
    const Aabb box{Vec3(offset), Vec3(offset) + 4 * scale};
    const std::vector<Region> regions =
        regions_of(random_areas(24, random, box, static_cast<double>(scale)));
    const std::vector<std::uint32_t> order = ascending(regions.size());
    const AreaList list(regions, order);
    const std::array octrees{AreaOctree(regions, order, 1), AreaOctree(regions, order, 5),
                             AreaOctree(regions, order)};
    int faults = 0;
    for (std::size_t n = 0; n < points; n += 7) {
      const Vec3 point = next_point(random, box, regions);
      const auto check = [&](const Vec3& at) {
        faults += faults_at(list, regions, at);
        for (const AreaOctree& octree : octrees) faults += faults_at(octree, regions, at);
      };
      check(point);
      for (int k = 0; k < 3; ++k)
        for (const float towards : {-1e30F, 1e30F}) {
          Vec3 neighbor = point;
          neighbor[k] = std::nextafter(neighbor[k], towards);
          check(neighbor);
        }
    }
    CHECK(faults == 0);
  }
}

// Rays without a bundle: along the rays of areas, almost along them, and random.
std::vector<Ray> stray_rays(const std::vector<InfluenceArea>& areas, Random& random,
                            const Aabb& box, std::size_t count) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 origin = random.in_box(box);
    Vec3 direction = random.in_box({Vec3(-1), Vec3(1)});
    if (i % 4 != 0) {
      direction = Vec3(ray_direction(areas[i % areas.size()], DVec3(origin)));
      if (i % 4 == 2) direction = -direction;
      if (i % 4 == 3) direction += 0.02F * random.in_box({Vec3(-1), Vec3(1)});
    }
    const float t_max = i % 5 == 0 ? 0.3F : std::numeric_limits<float>::infinity();
    rays.push_back({origin, t_max, direction, no_bundle});
  }
  return rays;
}

}  // namespace

TEST_CASE("The list and the octree find every area that holds a point") { check_points(3000, 5); }

TEST_CASE("The list and the octree find every area that holds a point, 1e7 points", "[full]") {
  check_points(3'400'000, 6);
}

TEST_CASE("An area that begins or ends at a border between cells is found there") {
  const float border = 2;  // the center
  const Aabb all{Vec3(0), Vec3(4)};
  for (int k = 0; k < 3; ++k)
    for (const float at : {std::nextafter(border, 0.0F), border, std::nextafter(border, 4.0F)}) {
      Aabb below = all, above = all;
      below.max[k] = at;
      above.min[k] = at;
      const std::vector<Region> regions{all, below, above};
      for (const int depth : {1, 2, 6}) {
        const AreaOctree octree(regions, ascending(regions.size()), depth);
        for (const float near : {std::nextafter(at, 0.0F), at, std::nextafter(at, 4.0F)}) {
          Vec3 point(1);
          point[k] = near;
          CHECK(faults_at(octree, regions, point) == 0);
        }
      }
    }
}

TEST_CASE("An octree's certain candidates hold the whole cell") {
  Random random(9);
  const Aabb box{Vec3(0), Vec3(4)};
  const std::vector<Region> regions = regions_of(random_areas(12, random, box, 2));
  const AreaOctree octree(regions, ascending(regions.size()), 6);
  int certain = 0;
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 point = random.in_box(box);
    for (const AreaCandidate& candidate : octree.leaf_of(point)) {
      if (!candidate.certain) continue;
      ++certain;
      // Up to rounding.
      CHECK(exit_distance(regions[candidate.area], {point, 1, Vec3(1, 0, 0), no_bundle}) >= 0);
      CHECK(overlaps(regions[candidate.area], Aabb{point, point}));
    }
  }
  CHECK(certain > 1000);
}

TEST_CASE("An octree has the depth that is set, and a bounded size") {
  Random random(3);
  const Aabb box{Vec3(0), Vec3(4)};
  const std::vector<Region> regions = regions_of(random_areas(256, random, box, 2));
  const std::vector<std::uint32_t> order = ascending(regions.size());
  std::size_t nodes = 1;
  for (int depth = 1; depth <= 4; ++depth) {
    const AreaOctree octree(regions, order, depth);
    CHECK(octree.depth() == depth);
    CHECK(octree.nodes() > nodes);
    nodes = octree.nodes();
  }
  const AreaOctree chosen(regions, order);
  CHECK(chosen.depth() >= 3);
  CHECK(chosen.nodes() <= AreaOctree::default_max_nodes);
  const AreaOctree none({}, {});
  CHECK(none.leaf_of(Vec3(0)).empty());
}

TEST_CASE("Rays without a bundle are answered like by brute force for every kind of top level") {
  std::uint32_t seed = 40;
  for (const Soup& soup : all_soups()) {
    if (soup.indices.empty()) continue;
    INFO(soup.name);
    Random random(++seed);
    Aabb box = bounds_of(soup.triangles());
    const Vec3 size = glm::max(box.extent(), Vec3(1e-3F * glm::length(box.extent())));
    box = {box.center() - 0.75F * size, box.center() + 0.75F * size};
    const auto scale = static_cast<double>(glm::length(size));
    const std::vector<InfluenceArea> areas = random_areas(9, random, box, scale);
    std::vector<LocalArea> declared;
    for (const InfluenceArea& area : areas) declared.push_back({area, 7});
    const std::vector<Ray> rays = stray_rays(areas, random, box, 1500);
    const Answers expected = ask(*make_brute_force(soup.triangles()), rays);
    for (const TopLevelKind kind : {TopLevelKind::none, TopLevelKind::list, TopLevelKind::octree})
      for (const double tolerance : {0.0, 0.05, 4.0}) {
        LocalConfig config;
        config.top_level = {kind, seed % 2 == 0 ? 4 : 0, tolerance};
        check_same(expected, ask(*make_local_bvhs(soup.triangles(), declared, config), rays));
      }
  }
}

TEST_CASE("An area is asked for rays that start in it and run along its rays") {
  const Soup soup = random_soup(2000, 0.05F, Vec3{0}, 10);
  const LocalArea area{make_plane_area(DVec3(0, 5, 0), DVec3(0, -1, 0), DVec2(4), 10), 3};
  const Ray along{Vec3(1, 2, 1), 100, Vec3(0, -1, 0), no_bundle};
  const Ray back{Vec3(1, 2, 1), 100, Vec3(0, 2, 0), no_bundle};
  const Ray oblique{Vec3(1, 2, 1), 100, Vec3(0.1F, -1, 0), no_bundle};
  const Ray outside{Vec3(3, 2, 1), 100, Vec3(0, -1, 0), no_bundle};
  const auto asked = [&](TopLevelKind kind, double tolerance, const Ray& ray) {
    LocalConfig config;
    config.top_level = {kind, 5, tolerance};
    return make_local_bvhs(soup.triangles(), {area}, config)->area_of(ray).has_value();
  };
  for (const TopLevelKind kind : {TopLevelKind::list, TopLevelKind::octree}) {
    CHECK(asked(kind, 0, along));
    CHECK(asked(kind, 0, back));
    CHECK_FALSE(asked(kind, 0, oblique));
    CHECK_FALSE(asked(kind, 0.09, oblique));
    CHECK(asked(kind, 0.11, oblique));
    CHECK(asked(kind, 4, oblique));
    CHECK_FALSE(asked(kind, 4, outside));
  }
  CHECK_FALSE(asked(TopLevelKind::none, 4, along));
}

TEST_CASE("The cheapest of several areas that hold a ray's origin answers") {
  const Soup soup = random_soup(3000, 0.05F, Vec3{0}, 10);
  const LocalArea wide{make_plane_area(DVec3(0, 9, 0), DVec3(0, -1, 0), DVec2(18), 18), 3};
  const LocalArea narrow{make_plane_area(DVec3(0, 9, 0), DVec3(0, -1, 0), DVec2(2), 9), 3};
  LocalConfig config;
  for (const TopLevelKind kind : {TopLevelKind::list, TopLevelKind::octree})
    for (const auto& areas : {std::vector{wide, narrow}, {narrow, wide}}) {
      config.top_level = {kind, 0, 0};
      const auto local = make_local_bvhs(soup.triangles(), areas, config);
      const std::vector<LocalBvhReport>& reports = local->reports();
      REQUIRE(reports[0].predicted_cost != reports[1].predicted_cost);
      const std::size_t cheaper = reports[0].predicted_cost < reports[1].predicted_cost ? 0 : 1;
      for (const std::uint32_t bundle : {std::uint32_t{3}, no_bundle})
        CHECK(local->area_of({Vec3(0, 3, 0), 100, Vec3(0, -1, 0), bundle}) == cheaper);
    }
}
