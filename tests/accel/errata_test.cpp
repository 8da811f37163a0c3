// Tests of the thesis's text about local BVHs and the top level (chapter 3) and about building and
// traversing trees (1.3.3, 5.1) where it is wrong as printed. Each printed rule stands beside the
// correct one, so that nobody "corrects" the code back. CONTRIBUTING.md lists all such tests.
#include <deque>
#include <pah/accel/local_bvhs.hpp>
#include <pah/bvh/analyze.hpp>
#include <pah/influence/bundle_area.hpp>

#include "accel/local/build_local.hpp"
#include "accel/local/bundle_heuristic.hpp"
#include "accel/local/top_level.hpp"
#include "bvh/bvh_cost.hpp"
#include "catch.hpp"
#include "geometry/ray_triangle.hpp"
#include "support/answers.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

namespace {

constexpr std::uint32_t lamp = 7;
constexpr float endless = std::numeric_limits<float>::infinity();

Hit nearest(const Accelerator& accelerator, const Ray& ray) {
  return ask(accelerator, {ray}).hits[0];
}
Hit nearest(const Soup& soup, const Ray& ray) {
  return nearest(*make_brute_force(soup.triangles()), ray);
}

Soup part_of(const Soup& soup, const std::vector<std::uint32_t>& subset) {
  Soup part{soup.name, soup.positions, {}};
  for (const std::uint32_t i : subset) part.indices.push_back(soup.indices[i]);
  return part;
}

// Section 3.2: the triangles of which "at least one of its vertices or edges is inside". An edge is
// a triangle without area.
std::vector<std::uint32_t> printed_local_triangles(const Soup& soup, const Region& region) {
  std::vector<std::uint32_t> subset;
  for (std::uint32_t i = 0; i < soup.indices.size(); ++i) {
    const Triangle t = soup.triangles()[i];
    if (overlaps(region, Triangle{t.a, t.b, t.b}) || overlaps(region, Triangle{t.b, t.c, t.c}) ||
        overlaps(region, Triangle{t.c, t.a, t.a}))
      subset.push_back(i);
  }
  return subset;
}

// Section 3.2: a hit in the local BVH "is guaranteed to be the closest one"; without a hit the
// global BVH is traversed.
Hit printed_nearest(const Soup& soup, const std::vector<std::uint32_t>& local, const Ray& ray) {
  const Hit hit = nearest(part_of(soup, local), ray);
  return hit.valid() ? hit : nearest(soup, ray);
}

// A square across the z axis.
void add_wall(Soup& soup, float z, float half) {
  soup.add({-half, -half, z}, {half, -half, z}, {half, half, z});
  soup.add({-half, -half, z}, {half, half, z}, {-half, half, z});
}

// A ray that leaves its area through the side at x = 1. It meets triangle 1, which is outside, at t
// = 2 and triangle 0, another part of which is inside, at t = 3.
struct SidewaysRay {
  InfluenceArea area = make_plane_area(DVec3(0), DVec3(0, 0, 1), DVec2(2), /*depth=*/10);
  Soup soup;
  Ray ray{{0, 0, 5}, endless, {1, 0, 0}};

  SidewaysRay() {
    soup.add({0, 0, 9}, {6, -4, 1}, {6, 4, 1});
    soup.add({2, -1, 4.5F}, {2, 1, 4.5F}, {2, 0, 6});
  }
};

// Algorithm 5.2, with the number of nodes that a ray is tested against.
struct PrintedTraversal {
  Hit hit;
  std::uint64_t nodes = 0;
};
PrintedTraversal printed_traverse(const BinaryTree& tree, const Triangles& triangles,
                                  const Ray& ray) {
  const PreparedRay prepared = prepare(ray);
  PrintedTraversal done;
  done.hit = nothing_yet(ray.t_max);
  std::deque<std::uint32_t> to_visit{0};
  while (!to_visit.empty()) {
    const BinaryTree::Node& node = tree.nodes[to_visit.front()];
    to_visit.pop_front();
    ++done.nodes;
    const SlabInterval interval = intersect_box(prepared, padded(node.box));
    if (interval.near > interval.far || interval.near >= done.hit.t) continue;
    if (!node.leaf()) {
      to_visit.insert(to_visit.end(), {node.first, node.first + 1});
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      update_nearest(prepared, triangles[tree.order[i]], tree.order[i], done.hit);
  }
  return done;
}

// Section 5.1.2: the cost of a ray that visits every node.
double printed_cost_of_all(const BinaryTree& tree) {
  double cost = 0;
  for (const BinaryTree::Node& node : tree.nodes) cost += node.leaf() ? node.count * 1 : 2 * 1.2;
  return cost;
}

// A root over a leaf of 3 triangles and an inner node over leaves of 2 and 5.
BinaryTree five_nodes() {
  const auto box = [](float from, float to) { return Aabb{{from, 0, 0}, {to, 2, 2}}; };
  BinaryTree tree;
  tree.nodes = {{box(0, 4), 1, 0},
                {box(0, 2.5F), 3, 0},
                {box(1.5F, 4), 7, 3},
                {box(0, 1), 0, 2},
                {box(1, 2.5F), 2, 5}};
  tree.order = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  return tree;
}

// The measure for rays that all meet every box.
struct Always {
  [[nodiscard]] float operator()(const Aabb& /*box*/) const { return 1; }
};

// Section 1.3.3; the true surface area is twice this.
double printed_surface_area(const Aabb& box) {
  const DVec3 size(box.extent());
  return size.x * size.y + size.x * size.z + size.y * size.z;
}

// Chapter 4, "quality of x axis" and so on.
std::array<RatedAxis, 3> printed_qualities(const DVec3& v) {
  const double sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
  return {RatedAxis{0, std::abs(v.x) / sum}, {1, std::abs(v.y) / sum}, {2, std::abs(v.z) / sum}};
}

}  // namespace

// Section 3.2, which triangles are inside.
TEST_CASE("A wall that an area pierces stops its rays, though no printed local BVH has it") {
  const InfluenceArea area = make_plane_area(DVec3(0), DVec3(0, 0, 1), DVec2(0.02), /*depth=*/10);
  Soup soup;
  soup.add({-9, -9, 5}, {9, -9, 5}, {0, 9, 5});
  soup.add({-0.1F, -0.1F, 8}, {0.1F, -0.1F, 8}, {0, 0, 8});
  const std::vector<std::uint32_t> printed = printed_local_triangles(soup, region_of(area));
  CHECK(printed == std::vector<std::uint32_t>{1});
  CHECK(local_triangles(soup.triangles(), area).subset == std::vector<std::uint32_t>{0, 1});
  const Ray ray{{0, -0.005F, 1}, endless, {0, 0, 1}, lamp};
  CHECK(printed_nearest(soup, printed, ray).t == 7);
  CHECK(nearest(*make_local_bvhs(soup.triangles(), {{area, lamp}}), ray).t == 4);
}

// Section 3.2, "guaranteed".
TEST_CASE("A hit beyond the area is not the nearest, though the printed rule guarantees it") {
  SidewaysRay setting;
  const std::vector<std::uint32_t> local =
      printed_local_triangles(setting.soup, region_of(setting.area));
  REQUIRE(local == std::vector<std::uint32_t>{0});
  setting.ray.bundle = lamp;
  CHECK(printed_nearest(setting.soup, local, setting.ray).t == 3);
  const auto ours = make_local_bvhs(setting.soup.triangles(), {{setting.area, lamp}});
  CHECK(nearest(*ours, setting.ray).t == 2);
  CHECK(ours->area_of(setting.ray) == std::size_t{0});  // its local BVH was traversed
}

// Section 3.3: "read the data in the leaf".
TEST_CASE(
    "A point in an octree's cell is not in all of the cell's areas, as the printed top level "
    "assumes") {
  const InfluenceArea area = make_point_area(DVec3(0), DVec3(0, 0, 1), DVec2(std::acos(0.0)),
                                             /*near=*/0, /*far=*/4);
  Soup soup;
  soup.add({0.75F, -1, 0.2F}, {0.75F, 1, 0.2F}, {0.75F, 0, 3});  // reaches into the area
  soup.add({2, 0, 0.5F}, {2, 0.7F, 0.5F}, {2, 0.35F, 1});        // does not
  const Vec3 origin(3, 0.5F, 1);
  const Ray ray{origin, endless, -origin};  // runs along the area's rays

  const std::vector<Region> regions{region_of(area)};
  const AreaOctree octree(regions, std::vector<std::uint32_t>{0}, 1);
  REQUIRE(octree.leaf_of(origin).size() == 1);
  CHECK_FALSE(octree.leaf_of(origin)[0].certain);
  CHECK_FALSE(contains(regions[0], origin));
  const std::vector<std::uint32_t> local = printed_local_triangles(soup, regions[0]);
  REQUIRE(local == std::vector<std::uint32_t>{0});
  CHECK(printed_nearest(soup, local, ray).t == Approx(0.75));
  LocalConfig config;
  config.top_level = {TopLevelKind::octree, 1, 0};
  const auto ours = make_local_bvhs(soup.triangles(), {{area, no_bundle}}, config);
  CHECK(nearest(*ours, ray).t == Approx(1.0 / 3));
  CHECK_FALSE(ours->area_of(ray).has_value());
}

// Section 3.2: "when no hit is found, it is necessary to traverse the global BVH".
TEST_CASE(
    "A segment within an area that hits nothing is answered, and not traced again as printed") {
  // The eye's coordinates are not floats: rounded segments end slightly beyond it, outside.
  const DVec3 eye(0.1, 0.2, 0.7);
  const InfluenceArea area = make_point_area(eye, DVec3(0, 0, 1), DVec2(1), /*near=*/0, /*far=*/10);
  Soup soup;
  add_wall(soup, -5, 90);
  Random random(1);
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = random.in_box({{-2, -2, 7}, {2, 2, 9}});
    rays.push_back({from, 1, Vec3(eye) - from, lamp});
  }
  const auto ours = make_local_bvhs(soup.triangles(), {{area, lamp}});
  std::vector<std::uint8_t> found(rays.size(), 2), truth(rays.size(), 2);
  TraversalCounts counts, printed_counts;
  ours->occluded(rays, found, &counts);
  make_global_bvh(soup.triangles())->occluded(rays, truth, &printed_counts);
  CHECK(found == truth);
  CHECK(found == std::vector<std::uint8_t>(rays.size(), 0));
  // The local BVH is empty: any visited node belongs to the global BVH.
  CHECK(printed_counts.nodes >= rays.size());
  CHECK(counts.nodes == 0);
  CHECK(ours->uses()[0].answered == rays.size());
}

// Figure 3.2 and section 5.4.2: the frustum begins at its near plane.
TEST_CASE("What stands before the near plane stops segments, though it is outside the frustum") {
  const InfluenceArea area =
      make_point_area(DVec3(0), DVec3(0, 0, 1), DVec2(1), /*near=*/1, /*far=*/10);
  Soup soup;
  add_wall(soup, 0.5F, 1);
  add_wall(soup, 9, 1);
  const std::vector<std::uint32_t> local = printed_local_triangles(soup, region_of(area));
  REQUIRE(local == std::vector<std::uint32_t>{2, 3});
  const Ray segment{{0.5F, 0.25F, 8}, 1, {-0.5F, -0.25F, -8}, lamp};
  // By the local BVH's answer alone, the segment hits nothing.
  CHECK_FALSE(nearest(part_of(soup, local), segment).valid());
  const auto ours = make_local_bvhs(soup.triangles(), {{area, lamp}});
  CHECK(nearest(*ours, segment).t == Approx(7.5 / 8));
  CHECK(ask(*ours, {segment}).occluded[0] == 1);
}

// Section 3.1: "if the tolerance gets too large ...".
TEST_CASE("A tolerance changes no answer, though it does by the printed rules") {
  const SidewaysRay setting;
  const std::vector<std::uint32_t> local =
      printed_local_triangles(setting.soup, region_of(setting.area));
  const auto printed = [&](double tolerance) {
    return is_affine(setting.area, setting.ray, tolerance)
               ? printed_nearest(setting.soup, local, setting.ray)
               : nearest(setting.soup, setting.ray);
  };
  CHECK(printed(0).t == 2);
  CHECK(printed(4).t == 3);
  for (const TopLevelKind kind : {TopLevelKind::list, TopLevelKind::octree})
    for (const double tolerance : {0.0, 0.05, 4.0}) {
      LocalConfig config;
      config.top_level = {kind, 0, tolerance};
      const auto ours =
          make_local_bvhs(setting.soup.triangles(), {{setting.area, no_bundle}}, config);
      CHECK(nearest(*ours, setting.ray).t == 2);
      CHECK(ours->area_of(setting.ray).has_value() == (tolerance == 4));
    }
}

// Section 5.1.2, algorithm 5.2.
TEST_CASE(
    "The nearest wall is found by a look at few nodes, where the printed queue visits hundreds") {
  Soup soup;
  for (int i = 0; i < 1000; ++i) add_wall(soup, static_cast<float>(i), 1);
  const BuiltBvh built = build_bvh(soup.triangles());
  const Ray ray{{0.25F, 0.5F, -1}, endless, {0, 0, 1}};
  const PrintedTraversal printed = printed_traverse(built.tree, soup.triangles(), ray);
  Hit hit;
  TraversalCounts counts;
  closest_hits(built.bvh, {&ray, 1}, {&hit, 1}, &counts);
  CHECK(hit.t == 1);
  CHECK(printed.hit.t == 1);
  CHECK(printed.nodes > 500);
  CHECK(counts.nodes < 20);
}

// Section 5.1.2 counts a triangle as 1 and a box as 1.2; section 1.3.3 has them the other way
// round.
TEST_CASE("A box costs 1 and a block of triangles 1.2, not the reverse as printed") {
  const BinaryTree tree = five_nodes();
  const std::vector<Vec3> positions(3, Vec3(0, 0, 0));  // no area: nothing is hit
  const std::vector<UVec3> indices(10, UVec3{0, 1, 2});
  const Bvh bvh = collapse(tree, std::vector<float>{20, 14, 14, 8, 10},
                           Triangles{positions, indices}, tree.order);
  const Ray ray{{-1, 1, 1}, endless, {1, 0, 0}};  // through every box
  Hit hit;
  TraversalCounts counts;
  closest_hits(bvh, {&ray, 1}, {&hit, 1}, &counts);
  // One inner node of eight children; leaves of 2, 5 and 3 triangles.
  CHECK(counts.inner_nodes == 1);
  CHECK(counts.blocks == 4);
  const double truth = 1 + 4 * 1.2;
  CHECK(traversal_cost(counts) == Approx(truth));
  CHECK(expected_cost(bvh, each_box(Always{}), 1) == Approx(truth));  // as predicted
  // The builder counts two inner nodes of two boxes.
  CHECK(expected_cost(tree, {}, each_box(Always{})) == Approx(2 * 2 + 4 * 1.2));
  CHECK(printed_cost_of_all(tree) == Approx(2 * 2 * 1.2 + 10));
}

// Section 1.3.3: half the surface area, which is correct only in ratios.
TEST_CASE("What all rays hit costs the same by surface and by projected area") {
  const Aabb cube{Vec3(-1), Vec3(1)};
  BinaryTree leaf;
  leaf.nodes.push_back({cube, 0, 4});
  leaf.order = {0, 1, 2, 3};
  const ParallelBundleArea along_z(DVec3(0, 0, 1));
  CHECK(expected_cost(leaf, {}, each_box(SurfaceArea{})) == Approx(1.2));
  CHECK(expected_cost(leaf, {}, each_box(along_z)) == Approx(1.2));
  // A cube of six faces of area 4; rays along an axis see one of them.
  const double surface = 24, seen = 4;
  CHECK(printed_surface_area(cube) == surface / 2);
  CHECK(double{along_z(cube)} == Approx(seen));
  // Not divided by the root's, the printed area gives one block the cost of three.
  CHECK(printed_surface_area(cube) * 1.2 == Approx(3 * seen * 1.2));
}

// Chapter 4 and section 5.1.1, algorithm 5.1: `quality < threshold` rejects.
TEST_CASE("Rays along z do not split z, as they do by the printed quality") {
  const InfluenceArea area = make_plane_area(DVec3(0), DVec3(0, 0, 1), DVec2(4), /*depth=*/10);
  std::vector<Aabb> boxes;
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y)
      for (int z = 4; z < 36; ++z) {
        const Vec3 at = 0.25F * Vec3(x, y, z);
        boxes.push_back({at, at + 0.25F});
      }
  LocalConfig config;
  config.heuristic = Heuristic::projected_area;
  config.split = SplitAxis::facing;
  // The sum of the hit probabilities of the root's halves over its own.
  const auto ratio = [&](const BuildHeuristic& heuristic) {
    const BinaryTree tree = build_tree(boxes, config.build, heuristic);
    const BinaryTree::Node& root = tree.nodes[0];
    REQUIRE_FALSE(root.leaf());
    return (hit_probability(area, tree.nodes[root.first].box) +
            hit_probability(area, tree.nodes[root.first + 1].box)) /
           hit_probability(area, root.box);
  };
  BuildHeuristic heuristic = bundle_heuristic(area, config);
  CHECK(ratio(heuristic) == Approx(1));
  REQUIRE(heuristic.search);
  heuristic.search->rate = [](const Aabb& /*box*/) { return printed_qualities({0, 0, 1}); };
  CHECK(ratio(heuristic) == Approx(2));
}
