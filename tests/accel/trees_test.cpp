// Tests the analysis of trees through the public headers alone.
#include <algorithm>
#include <pah/accel/trees.hpp>
#include <pah/bvh/analyze.hpp>
#include <pah/influence/bundle_area.hpp>

#include "catch.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

TEST_CASE("Trees of scenes and areas name their triangles, and visitors gather statistics") {
  const Soup soup = random_soup(3000, 0.05F, Vec3{0}, 10);
  const Triangles triangles = soup.triangles();
  const InfluenceArea sun = make_plane_area(DVec3(0, 9, 0), DVec3(0, -1, 0), DVec2(6), 9);
  const BinaryTree whole = scene_tree(triangles);
  const BinaryTree local = area_tree(triangles, sun);
  CHECK(whole.order.size() == triangles.size());
  CHECK(local.order.size() < triangles.size());
  CHECK(local.order.size() > 100);
  for (const BinaryTree* tree : {&whole, &local}) {
    // The visitor finds the triangles of the deepest leaf.
    std::uint32_t deepest = 0, triangles_there = 0;
    const bool all_in_boxes = visit_tree(
        *tree,
        [&, inside = true](const NodeVisit& visit) mutable {
          if (!visit.node().leaf()) return;
          if (visit.depth > deepest) {
            deepest = visit.depth;
            triangles_there = visit.node().count;
          }
          for (std::uint32_t i = 0; i < visit.node().count; ++i) {
            const Aabb box = triangles[tree->order[visit.node().first + i]].bounds();
            inside = inside && glm::all(glm::lessThanEqual(visit.node().box.min, box.min)) &&
                     glm::all(glm::greaterThanEqual(visit.node().box.max, box.max));
          }
          CHECK(inside);
        },
        [&] { return triangles_there > 0; });
    CHECK(all_in_boxes);
    CHECK(deepest == summarize(*tree, each_box(SurfaceArea{})).max_depth);
  }
}

TEST_CASE("Siblings that do not meet overlap in a bundle's view if they lie behind one another") {
  const Aabb lower{Vec3(0, 0, 0), Vec3(2, 1, 2)}, upper{Vec3(1, 3, 0), Vec3(3, 4, 2)};
  Aabb node = lower;
  node.extend(upper);
  // From above: 3 x 2, of which 1 x 2 is common to both.
  const InfluenceArea above = make_plane_area(DVec3(1, 9, 1), DVec3(0, -1, 0), DVec2(20), 20);
  CHECK(seen_overlap(above, node, lower, upper) == Approx(2.0 / 6));
  const InfluenceArea aside = make_plane_area(DVec3(1, 2, 9), DVec3(0, 0, -1), DVec2(20), 20);
  CHECK(seen_overlap(aside, node, lower, upper) == 0);
  // Clipped to the area, x up to 1.5: 0.5 x 2 of 1.5 x 2.
  const InfluenceArea part = make_plane_area(DVec3(-8.5, 9, 1), DVec3(0, -1, 0), DVec2(20), 20);
  CHECK(seen_overlap(part, node, lower, upper) == Approx(1.0 / 3));
  // From a point above the middle of both, the upper one hides more than lies below it.
  const InfluenceArea bulb = make_point_area(DVec3(1.5, 8, 1), DVec3(0, -1, 0), DVec2(1.5), 0, 20);
  const double seen = seen_overlap(bulb, node, lower, upper);
  CHECK(seen > 0.05);
  CHECK(seen < 1);
  const InfluenceArea away = make_plane_area(DVec3(50, 9, 1), DVec3(0, -1, 0), DVec2(2), 20);
  CHECK(seen_overlap(away, node, lower, upper) == 0);
}
