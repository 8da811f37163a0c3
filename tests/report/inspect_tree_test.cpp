// Tests the measures of a tree made by hand.
#include <pah/bvh/analyze.hpp>
#include <pah/bvh/build_config.hpp>

#include "bvh/bvh_cost.hpp"
#include "catch.hpp"
#include "hand_made_tree.hpp"
#include "report/inspect/inspect_report.hpp"

using namespace pah;

TEST_CASE("A visit meets every node once, level by level, then ends") {
  const BinaryTree tree = test::hand_made_tree();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> seen;
  const auto see = [&](const NodeVisit& visit) { seen.emplace_back(visit.index, visit.depth); };
  const std::size_t total = visit_tree(tree, see, [&] { return seen.size(); });
  CHECK(total == 5);
  CHECK(seen == std::vector<std::pair<std::uint32_t, std::uint32_t>>{
                    {0, 0}, {1, 1}, {2, 1}, {3, 2}, {4, 2}});
}

TEST_CASE("A visit to an empty tree only ends") {
  int nodes = 0;
  CHECK(visit_tree(
            BinaryTree{}, [&](const NodeVisit&) { ++nodes; }, [] { return 7; }) == 7);
  CHECK(nodes == 0);
}

TEST_CASE("The summary of a tree is exact") {
  const TreeSummary sum = summarize(test::hand_made_tree(), each_box(SurfaceArea{}));
  CHECK(sum.triangles == 10);
  CHECK(sum.nodes == 5);
  CHECK(sum.leaves == 3);
  CHECK(sum.max_depth == 2);
  CHECK(sum.mean_depth == Approx(5.0 / 3));
  CHECK(sum.leaf_sizes == std::vector<std::uint64_t>{0, 0, 1, 1, 0, 1});

  REQUIRE(sum.levels.size() == 3);
  CHECK(sum.levels[0].nodes == 1);
  CHECK(sum.levels[0].leaves == 0);
  CHECK(sum.levels[0].overlap == Approx(8.0 / 20));
  CHECK(sum.levels[1].nodes == 2);
  CHECK(sum.levels[1].leaves == 1);
  CHECK(sum.levels[1].overlap == Approx(4.0 / 14));
  CHECK(sum.levels[2].nodes == 2);
  CHECK(sum.levels[2].leaves == 2);
  CHECK(sum.levels[2].overlap == 0);
  CHECK(sum.overlap == Approx((8.0 / 20 + 4.0 / 14) / 2));

  // Two box tests for an inner node, one test of a block for up to four triangles: over the root's
  // area, 2 * 20 + 2 * 14 + 1.2 * (14 + 8 + 2 * 10).
  CHECK(expected_cost(test::hand_made_tree(), {}, each_box(SurfaceArea{})) ==
        Approx((2 * 20 + 2 * 14 + 1.2 * (14 + 8 + 2 * 10)) / 20));
}

TEST_CASE("The expected cost of a traversal is exact") {
  const BinaryTree tree = test::hand_made_tree();
  const std::vector<Vec3> positions(3);
  const std::vector<UVec3> indices(10, UVec3{0, 1, 2});
  const BoxMeasure measure = each_box(SurfaceArea{});
  const Bvh bvh = collapse(tree, std::vector<float>{20, 14, 14, 8, 10},
                           Triangles{positions, indices}, tree.order);
  REQUIRE(bvh.nodes.size() == 1);
  // One node for the three leaves' boxes, then a block each and a second one for five triangles.
  CHECK(expected_cost(bvh, measure, 20) == Approx(1 + 1.2 * (14 + 8 + 2 * 10) / 20));
  CHECK(expected_cost(bvh, measure, 40) == Approx(1 + 1.2 * (14 + 8 + 2 * 10) / 40));
  CHECK(expected_cost(bvh, measure, 0) == 1);
  CHECK(expected_cost(Bvh{}, measure, 20) == 0);
}

TEST_CASE("Siblings apart do not overlap, nor do those of a box without area") {
  BinaryTree tree = test::hand_made_tree();
  tree.nodes[4].box.min.x = 1.25F;
  CHECK(summarize(tree, each_box(SurfaceArea{})).levels[1].overlap == 0);
  for (BinaryTree::Node& node : tree.nodes) node.box = {Vec3{1}, Vec3{1}};
  CHECK(summarize(tree, each_box(SurfaceArea{})).overlap == 0);
}

TEST_CASE("The balance of a tree is that of its large nodes") {
  BinaryTree tree = test::hand_made_tree();
  CHECK(balance_of(tree).nodes == 0);
  CHECK(balance_of(tree).smaller_share == 0);
  // 2 and 98 of 100 below one of two sides of 100 and 300.
  tree.nodes[3].count = 2;
  tree.nodes[4].count = 98;
  tree.nodes[2].count = 300;
  const TreeBalance balance = balance_of(tree);
  CHECK(balance.nodes == 2);
  CHECK(balance.smaller_share == Approx((0.25 + 0.02) / 2));
  CHECK(balance.smallest_share == Approx(0.02));
  CHECK(balance.lopsided == 0.5);
}

TEST_CASE("An empty tree has an empty summary") {
  const TreeSummary sum = summarize(BinaryTree{}, each_box(SurfaceArea{}));
  CHECK(sum.nodes == 0);
  CHECK(sum.levels.empty());
  CHECK(sum.mean_depth == 0);
  CHECK(sum.overlap == 0);
}

TEST_CASE("How siblings overlap as rays see them depends on where the rays run") {
  const BinaryTree tree = test::hand_made_tree();
  const auto seen_along = [&](const DVec3& direction) {
    return seen_overlaps(
        tree, make_plane_area(DVec3(2, 1, 1) - 10.0 * direction, direction, DVec2(20), 30));
  };
  // The root's children share 1 of 4; those of its left child only touch.
  const SeenOverlap across = seen_along(DVec3(0, 1, 0));
  REQUIRE(across.levels.size() == 3);
  CHECK(across.levels[0] == Approx(0.25));
  CHECK(across.levels[1] == Approx(0).margin(1e-12));
  CHECK(across.levels[2] == 0);
  CHECK(across.all == Approx(0.125));
  // For rays along the row, all boxes are behind one another.
  const SeenOverlap along = seen_along(DVec3(1, 0, 0));
  CHECK(along.levels[0] == Approx(1));
  CHECK(along.all == Approx(1));
  CHECK(seen_overlaps(BinaryTree{}, make_plane_area(DVec3(0), DVec3(1, 0, 0), DVec2(1), 1)).all ==
        0);
}
