// Tests the balance of trees where rays see siblings behind one another.
#include <pah/accel/trees.hpp>
#include <pah/bvh/analyze.hpp>

#include "catch.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

namespace {

// A tall heap under a sun at the zenith.
Soup heap() {
  Soup soup = random_soup(8000, 0.05F, Vec3{0}, 3);
  for (Vec3& position : soup.positions) position.y *= 10;
  return soup;
}

TreeSummary built(const Soup& soup, Heuristic heuristic, SplitAxis split, double least_share) {
  LocalConfig config;
  config.heuristic = heuristic;
  config.split = split;
  config.build.least_share = least_share;
  const InfluenceArea zenith = make_plane_area(DVec3(0, 30, 0), DVec3(0, -1, 0), DVec2(3, 3), 60);
  return summarize(area_tree(soup.triangles(), zenith, config), each_box(SurfaceArea{}));
}

}  // namespace

TEST_CASE(
    "PAH cuts off slivers along the rays, unless it may split across them or has a least share") {
  const Soup soup = heap();
  const auto pah = [&](SplitAxis split, double least_share) {
    return built(soup, Heuristic::projected_area, split, least_share);
  };
  const TreeSummary sah = built(soup, Heuristic::surface_area, SplitAxis::longest, 0);
  const TreeSummary along = pah(SplitAxis::longest, 0);
  CHECK(sah.balance.lopsided == 0);
  CHECK(along.balance.lopsided > 0.03);
  CHECK(along.mean_depth > 1.15 * sah.mean_depth);

  const TreeSummary across = pah(SplitAxis::best, 0);
  CHECK(across.balance.lopsided == 0);
  CHECK(across.mean_depth < sah.mean_depth);

  const TreeSummary held = pah(SplitAxis::longest, 0.25);
  CHECK(held.balance.lopsided == 0);
  CHECK(held.mean_depth < 0.9 * along.mean_depth);
}

TEST_CASE("Every child has at least the least share, whatever the heuristic") {
  const Soup soup = heap();
  for (const double least_share : {0.125, 0.5})
    for (const Heuristic heuristic : {Heuristic::surface_area, Heuristic::projected_area})
      for (const SplitAxis split : {SplitAxis::longest, SplitAxis::best, SplitAxis::facing}) {
        const TreeSummary summary = built(soup, heuristic, split, least_share);
        // Half of an odd number is rounded down by half an item.
        CHECK(summary.balance.smallest_share >= least_share - 0.5 / TreeBalance::least_triangles);
        CHECK(summary.balance.smallest_share <= 0.5);
      }
}
