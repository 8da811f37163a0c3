// Tests the effect of every parameter of a local BVH's build (thesis, 5.1) on the tree.
#include <algorithm>
#include <pah/bvh/analyze.hpp>
#include <pah/influence/bundle_area.hpp>

#include "accel/local/build_local.hpp"
#include "accel/local/bundle_heuristic.hpp"
#include "catch.hpp"
#include "support/soups.hpp"

using namespace pah;
using namespace pah::test;

namespace {

using Nodes = std::vector<std::pair<BinaryTree::Node, std::uint32_t>>;  // with their depths

class Trees {
 public:
  explicit Trees(const InfluenceArea& area) : area_(area) {
    subset_ = local_triangles(soup_.triangles(), area).subset;
    // Large leaves are allowed: otherwise most rules apply to small nodes only.
    config.build.max_leaf = 1'000'000;
    config.build.side_by_side = 1;
  }

  [[nodiscard]] BinaryTree tree() const {
    std::vector<Aabb> boxes;
    for (const std::uint32_t i : subset_) boxes.push_back(soup_.triangles()[i].bounds());
    return build_tree(boxes, config.build, bundle_heuristic(area_, config));
  }
  [[nodiscard]] Nodes nodes() const {
    Nodes nodes;
    const BinaryTree built = tree();
    visit_tree(
        built, [&](const NodeVisit& visit) { nodes.emplace_back(visit.node(), visit.depth); },
        [] {});
    return nodes;
  }
  [[nodiscard]] const InfluenceArea& area() const { return area_; }
  [[nodiscard]] std::size_t size() const { return subset_.size(); }

  LocalConfig config;

 private:
  Soup soup_ = random_soup(4000, 0.05F, Vec3{0}, 10);
  InfluenceArea area_;
  std::vector<std::uint32_t> subset_;
};

InfluenceArea sun() {
  return make_plane_area(DVec3(0, 9, 0), DVec3(0.3, -1, 0.1), DVec2(9, 7), 18);
}
InfluenceArea bulb() { return make_point_area(DVec3(0, 6, 0), DVec3(0, -1, 0), DVec2(1.2), 0, 12); }

std::uint32_t inner_nodes(const Nodes& nodes) {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(nodes, [](const auto& node) { return !node.first.leaf(); }));
}

// Checks that every inner node is beyond the rule, and that there are fewer of them than without
// it.
template <typename Beyond>
void check_rule(Trees& trees, const Nodes& without, const Beyond& beyond) {
  const Nodes with = trees.nodes();
  int within = 0;
  for (const auto& [node, depth] : with)
    if (!node.leaf() && !beyond(node.box, depth)) ++within;
  CHECK(within == 0);
  CHECK(inner_nodes(with) < inner_nodes(without));
  CHECK(inner_nodes(with) > 0);
}

}  // namespace

TEST_CASE("Nodes of less area or probability than a rule's limit are leaves") {
  for (const InfluenceArea& area : {sun(), bulb()})
    for (const Heuristic heuristic : {Heuristic::surface_area, Heuristic::projected_area}) {
      Trees trees(area);
      trees.config.heuristic = heuristic;
      const Nodes without = trees.nodes();
      const Aabb root = without.front().first.box;
      const bool by_bundle = heuristic == Heuristic::projected_area;
      const auto probability = [&](const Aabb& box) {
        return by_bundle ? hit_probability(area, box)
                         : double{SurfaceArea{}(box)} / double{SurfaceArea{}(root)};
      };
      const auto area_of = [&](const Aabb& box) {
        return by_bundle ? projected_area(area, box) : 2 * double{SurfaceArea{}(box)};
      };
      // Measures are rounded to float.
      const double least = 1 - 1e-6;
      trees.config.build.leaves.probability = 0.02;
      check_rule(trees, without, [&](const Aabb& box, std::uint32_t /*depth*/) {
        return probability(box) >= 0.02 * least;
      });
      trees.config.build.leaves = {};
      const double some_area = 0.05 * area_of(root);
      trees.config.build.leaves.area = some_area;
      check_rule(trees, without, [&](const Aabb& box, std::uint32_t /*depth*/) {
        return area_of(box) >= some_area * least;
      });
    }
}

TEST_CASE("Nodes that cost less as leaves than a rule's limit are leaves") {
  Trees trees(sun());
  trees.config.heuristic = Heuristic::projected_area;
  const Nodes without = trees.nodes();
  trees.config.build.leaves.cost = 0.5;
  const BinaryTree tree = trees.tree();
  std::vector<std::uint32_t> below(tree.nodes.size());
  int inner = 0;
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {  // children come after their parents
    const BinaryTree::Node& node = tree.nodes[i];
    below[i] = node.leaf() ? node.count : below[node.first] + below[node.first + 1];
    if (node.leaf()) continue;
    ++inner;
    CHECK(hit_probability(trees.area(), node.box) * double{leaf_cost(below[i], 1)} >=
          0.5 * (1 - 1e-6));
  }
  CHECK(inner > 0);
  CHECK(inner < static_cast<int>(inner_nodes(without)));
}

TEST_CASE("Nodes of fewer triangles than a rule's limit are leaves") {
  Trees trees(sun());
  const Nodes without = trees.nodes();
  trees.config.build.leaves.triangles = 40;
  const Nodes with = trees.nodes();
  CHECK(inner_nodes(with) < inner_nodes(without));
  const BinaryTree tree = trees.tree();
  std::vector<std::uint32_t> below(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const BinaryTree::Node& node = tree.nodes[i];
    below[i] = node.leaf() ? node.count : below[node.first] + below[node.first + 1];
    if (!node.leaf()) CHECK(below[i] >= 40);
  }
}

TEST_CASE("Leaves are no larger than allowed, and as deep as a rule's limit if that allows it") {
  Trees trees(sun());
  trees.config.build.max_leaf = 6;
  for (const auto& [node, depth] : trees.nodes()) CHECK((!node.leaf() || node.count <= 6));
  trees.config.build.max_leaf = 1'000'000;
  for (const std::uint32_t levels : {1U, 3U, 7U}) {
    trees.config.build.leaves.levels = levels;
    std::uint32_t deepest = 0;
    for (const auto& [node, depth] : trees.nodes()) deepest = std::max(deepest, depth);
    CHECK(deepest == levels);
  }
  // Nodes too large for a leaf are halved.
  trees.config.build.max_leaf = 6;
  trees.config.build.leaves.levels = 2;
  std::uint32_t deepest = 0;
  for (const auto& [node, depth] : trees.nodes()) {
    CHECK((!node.leaf() || node.count <= 6));
    deepest = std::max(deepest, depth);
  }
  CHECK(deepest > 2);
}

TEST_CASE("A tree of more bins costs less") {
  Trees trees(sun());
  trees.config.build.max_leaf = 4;
  double before = std::numeric_limits<double>::infinity();
  for (const std::uint32_t bins : {2U, 4U, 64U}) {
    trees.config.build.bins = bins;
    const double cost = expected_cost(trees.tree(), trees.config.build, each_box(SurfaceArea{}));
    CHECK(cost < before);
    before = cost;
  }
}

namespace {

// The axes of splits, breadth first: those along which the children's centers are farthest apart.
std::vector<int> split_axes(const BinaryTree& tree, std::uint32_t up_to_depth) {
  std::vector<int> axes;
  visit_tree(
      tree,
      [&](const NodeVisit& visit) {
        if (visit.node().leaf() || visit.depth > up_to_depth) return;
        const DVec3 gap =
            glm::abs(DVec3(visit.left().box.center()) - DVec3(visit.right().box.center())) /
            DVec3(visit.node().box.extent());
        axes.push_back(gap.x >= gap.y && gap.x >= gap.z ? 0 : gap.y >= gap.z ? 1 : 2);
      },
      [] {});
  return axes;
}

bool any(const std::vector<int>& axes, int axis) { return std::ranges::count(axes, axis) > 0; }

}  // namespace

TEST_CASE(
    "Only axes of enough facing quality are split, or the longest if no split is acceptable") {
  // The qualities of x, y and z are 0.9, 0.2 and 0.9.
  Trees trees(make_plane_area(DVec3(0, 9, 0), DVec3(0.125, -1, 0.125), DVec2(14), 18));
  trees.config.split = SplitAxis::facing;
  constexpr std::uint32_t top = 3;
  CHECK_FALSE(any(split_axes(trees.tree(), top), 1));
  trees.config.facing.threshold = 0.1;
  const BinaryTree all = trees.tree();
  CHECK(any(split_axes(all, top), 1));
  // No axis is good enough: the longest is split, y in a region that is higher than wide.
  Trees tall(make_plane_area(DVec3(0, 9, 0), DVec3(0.125, -1, 0.125), DVec2(3), 18));
  tall.config.split = SplitAxis::facing;
  tall.config.facing.threshold = 1;
  CHECK(split_axes(tall.tree(), 0) == std::vector<int>{1});
  tall.config.facing.threshold = 0.5;
  CHECK(split_axes(tall.tree(), 0) != std::vector<int>{1});
  // No split is acceptable: the longest axis is tried, too, and is the cheapest by SAH.
  tall.config.facing.acceptable_ratio = 0;
  CHECK(split_axes(tall.tree(), 0) == std::vector<int>{1});
}

TEST_CASE("An excellent split ends the search for a better one") {
  Trees trees(make_plane_area(DVec3(0, 9, 0), DVec3(0.05, -1, 0.1), DVec2(6, 12), 18));
  trees.config.split = SplitAxis::facing;
  trees.config.facing.threshold = 0.1;
  const auto axes_with = [&](double excellent) {
    trees.config.facing.excellent_ratio = excellent;
    return split_axes(trees.tree(), 3);
  };
  // Any split ends the search: only x, the axis that faces best, is split.
  const std::vector<int> at_once = axes_with(1e9);
  CHECK(std::ranges::count(at_once, 0) == static_cast<std::ptrdiff_t>(at_once.size()));
  // No split ends the search: the same tree as without the rule.
  const std::vector<int> searched = axes_with(1e-9);
  CHECK(searched == axes_with(0));
  CHECK(searched != at_once);
}

TEST_CASE("Nodes from a depth on are split by SAH along their longest axis") {
  Trees trees(make_plane_area(DVec3(0, 9, 0), DVec3(0, -1, 0), DVec2(14), 18));
  trees.config.heuristic = Heuristic::projected_area;
  trees.config.split = SplitAxis::facing;
  trees.config.build.max_leaf = 4;
  Trees plain(trees.area());
  plain.config.split = SplitAxis::longest;
  plain.config.build.max_leaf = 4;
  const auto same = [](const BinaryTree& a, const BinaryTree& b) {
    return a.order == b.order && a.nodes.size() == b.nodes.size();
  };
  trees.config.non_fallback_levels = 0;
  CHECK(same(trees.tree(), plain.tree()));
  // y, along which rays run, is never split above that depth, but below.
  trees.config.non_fallback_levels = 3;
  const BinaryTree tree = trees.tree();
  CHECK_FALSE(any(split_axes(tree, 2), 1));
  CHECK(any(split_axes(tree, 6), 1));
  trees.config.non_fallback_levels = 0xFFFFFFFFU;
  CHECK_FALSE(any(split_axes(trees.tree(), 6), 1));
}
