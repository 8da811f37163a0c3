// Tests that the builder makes valid, bounded and deterministic trees.
#include "bvh/build.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <pah/bvh/analyze.hpp>

#include "catch.hpp"
#include "support/soups.hpp"

using namespace pah;

namespace {

std::vector<Aabb> boxes_of(const test::Soup& soup) {
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < soup.indices.size(); ++i) {
    boxes.push_back(soup.triangles()[i].bounds());
  }
  return boxes;
}

bool same_tree(const BinaryTree& a, const BinaryTree& b) {
  return a.order == b.order && a.nodes.size() == b.nodes.size() &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(a.nodes[0])) == 0;
}

// Checks that every item is in exactly one leaf and every box is the union of those below. Returns
// the depth.
std::uint32_t check_tree(const BinaryTree& tree, const std::vector<Aabb>& boxes,
                         std::uint32_t max_leaf) {
  if (boxes.empty()) {
    CHECK(tree.empty());
    return 0;
  }
  std::vector<std::uint32_t> depth(tree.nodes.size());
  std::vector<int> seen(boxes.size());
  std::uint32_t deepest = 0;
  std::uint32_t wrong_boxes = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const BinaryTree::Node& node = tree.nodes[i];
    deepest = std::max(deepest, depth[i]);
    Aabb box;
    if (node.leaf()) {
      REQUIRE(node.count <= max_leaf);
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        ++seen.at(tree.order.at(k));
        box.extend(boxes[tree.order[k]]);
      }
    } else {
      REQUIRE(node.first > i);
      REQUIRE(node.first + 1 < tree.nodes.size());
      for (std::uint32_t child = node.first; child < node.first + 2; ++child) {
        depth[child] = depth[i] + 1;
        box.extend(tree.nodes[child].box);
      }
    }
    wrong_boxes += box == node.box ? 0 : 1;
  }
  CHECK(wrong_boxes == 0);
  CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  return deepest;
}

}  // namespace

TEST_CASE("A tree holds every triangle once, in tight boxes") {
  for (const test::Soup& soup : test::all_soups()) {
    INFO(soup.name);
    const std::vector<Aabb> boxes = boxes_of(soup);
    for (const std::uint32_t max_leaf : {1U, 4U, 16U}) {
      BuildConfig config;
      config.max_leaf = max_leaf;
      config.side_by_side = max_leaf;
      CHECK(check_tree(build_tree(boxes, config), boxes, max_leaf) <= max_depth);
    }
  }
}

TEST_CASE("A tree does not depend on the number of threads", "[threads]") {
  const std::vector<Aabb> boxes = boxes_of(test::random_soup(60000, 0.05F, Vec3{0}, 1));
  const BinaryTree expected = build_tree(boxes);
  for (const int threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] { CHECK(same_tree(expected, build_tree(boxes))); });
  }
}

TEST_CASE("Scaling a scene by a power of two scales its tree") {
  const std::vector<Aabb> boxes = boxes_of(test::random_soup(3000, 0.05F, Vec3{1, 2, 3}, 2));
  const BinaryTree expected = build_tree(boxes);
  for (int k = -20; k <= 20; ++k) {
    const float scale = std::ldexp(1.0F, k);
    std::vector<Aabb> scaled = boxes;
    for (Aabb& box : scaled) box = {scale * box.min, scale * box.max};
    BinaryTree tree = build_tree(scaled);
    for (BinaryTree::Node& node : tree.nodes) {
      node.box = {node.box.min / scale, node.box.max / scale};
    }
    CHECK(same_tree(expected, tree));
  }
}

TEST_CASE("A million identical triangles make a tree of the least depth") {
  const std::vector<Aabb> boxes(1000000, Aabb{{0, 0, 0}, {1, 1, 0}});
  const BinaryTree tree = build_tree(boxes);
  CHECK(check_tree(tree, boxes, BuildConfig{}.max_leaf) <= 20);
}

TEST_CASE("Lopsided input makes a tree of bounded depth") {
  // Each box is half as large as the one before: every split by cost separates one.
  std::vector<Aabb> boxes;
  for (int i = 0; i < 240; ++i) {
    const float size = std::ldexp(1.0F, 120 - i);
    boxes.insert(boxes.end(), 100, Aabb{Vec3{0}, Vec3{size}});
  }
  CHECK(check_tree(build_tree(boxes), boxes, BuildConfig{}.max_leaf) <= max_depth);
}

TEST_CASE("Boxes at the ends of float's range are split") {
  const float huge = 3e38F;
  std::vector<Aabb> boxes{{Vec3{-huge}, Vec3{huge}}};
  test::Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random.in_box({Vec3{-1}, Vec3{1}}) * (i % 2 == 0 ? huge : 1e-44F);
    boxes.push_back({p, p});
  }
  CHECK(check_tree(build_tree(boxes), boxes, BuildConfig{}.max_leaf) <= max_depth);
}

TEST_CASE("Splits by cost make cheaper trees than splits by halves") {
  const std::vector<Aabb> boxes = boxes_of(test::random_soup(5000, 0.02F, Vec3{0}, 3));
  const BoxMeasure blind_measure = [](std::span<const Aabb>, std::span<float> measures) {
    std::ranges::fill(measures, 1.0F);
  };
  const BinaryTree sah = build_tree(boxes);
  const BinaryTree blind = build_tree(boxes, {}, {blind_measure, any_axis});
  const BoxMeasure surface_area = each_box(SurfaceArea{});
  CHECK(expected_cost(sah, {}, surface_area) < 0.9 * expected_cost(blind, {}, surface_area));
}

TEST_CASE("A heuristic decides which axis is split") {
  // Boxes in a plane grid. Split along x only, siblings never overlap in x.
  std::vector<Aabb> boxes;
  for (int x = 0; x < 32; ++x) {
    for (int y = 0; y < 4; ++y) {
      const Vec3 at{x, y, 0};
      boxes.push_back({at, at + Vec3{0.5F, 0.5F, 1}});
    }
  }
  const auto only_x = [](const Aabb&) -> AxisMask { return 0b001; };
  const BinaryTree tree = build_tree(boxes, {.max_leaf = 4, .side_by_side = 1, .leaves = {}},
                                     {each_box(SurfaceArea{}), only_x});
  REQUIRE(tree.nodes.size() > 32);
  std::uint32_t overlaps = 0;
  for (const BinaryTree::Node& node : tree.nodes) {
    if (node.leaf()) continue;
    const Aabb& a = tree.nodes[node.first].box;
    const Aabb& b = tree.nodes[node.first + 1].box;
    overlaps += a.max.x <= b.min.x || b.max.x <= a.min.x ? 0 : 1;
  }
  CHECK(overlaps == 0);
}

TEST_CASE("A tree or BVH of too many parts is refused") {
  // The boxes are never read.
  const std::span<const Aabb> boxes(reinterpret_cast<const Aabb*>(alignof(Aabb)),
                                    std::size_t{1} << 31U);
  CHECK_THROWS_AS(build_tree(boxes), std::length_error);
  const ChildRef last = ChildRef::leaf(ChildRef::max_blocks - 1, 32);
  CHECK(last.is_leaf());
  CHECK(last.first_block() == ChildRef::max_blocks - 1);
  CHECK(last.triangles() == 32);
  CHECK_THROWS_AS(ChildRef::leaf(ChildRef::max_blocks, 1), std::length_error);
}
