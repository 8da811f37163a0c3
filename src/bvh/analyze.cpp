#include <algorithm>
#include <pah/bvh/analyze.hpp>

namespace pah {

double expected_cost(const BinaryTree& tree, const BuildConfig& config, const BoxMeasure& measure) {
  if (tree.empty()) return 0;
  double cost = 0;
  for (const BinaryTree::Node& node : tree.nodes) {
    const double tests =
        node.leaf() ? double{leaf_cost(node.count, config.side_by_side)} : 2 * double{box_cost};
    cost += tests * double{measure_of(measure, node.box)};
  }
  const double root = double{measure_of(measure, tree.nodes.front().box)};
  return root > 0 ? cost / root : cost;
}

double sibling_overlap(const NodeVisit& visit, const BoxMeasure& measure) {
  const Aabb& left = visit.left().box;
  const Aabb& right = visit.right().box;
  const Aabb both{glm::max(left.min, right.min), glm::min(left.max, right.max)};
  const double whole = double{measure_of(measure, visit.node().box)};
  return both.empty() || !(whole > 0) ? 0 : double{measure_of(measure, both)} / whole;
}

TreeBalance balance_of(const BinaryTree& tree) {
  TreeBalance balance;
  std::vector<std::uint32_t> triangles(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {  // children stand behind their parents
    const BinaryTree::Node& node = tree.nodes[i];
    triangles[i] = node.count;
    if (node.leaf()) continue;
    const std::uint32_t left = triangles[node.first], right = triangles[node.first + 1];
    triangles[i] = left + right;
    if (triangles[i] < TreeBalance::least_triangles) continue;
    const double share =
        static_cast<double>(std::min(left, right)) / static_cast<double>(triangles[i]);
    balance.smallest_share = balance.nodes == 0 ? share : std::min(balance.smallest_share, share);
    ++balance.nodes;
    balance.smaller_share += share;
    if (share < TreeBalance::lopsided_below) ++balance.lopsided;
  }
  if (balance.nodes == 0) return balance;
  balance.smaller_share /= static_cast<double>(balance.nodes);
  balance.lopsided /= static_cast<double>(balance.nodes);
  return balance;
}

TreeSummary summarize(const BinaryTree& tree, const BoxMeasure& measure) {
  TreeSummary sum;
  const auto per_node = [&](const NodeVisit& visit) {
    if (visit.depth == sum.levels.size()) sum.levels.emplace_back();
    TreeLevel& level = sum.levels[visit.depth];
    ++level.nodes;
    if (!visit.node().leaf()) {
      level.overlap += sibling_overlap(visit, measure);
      return;
    }
    const std::uint32_t size = visit.node().count;
    if (size >= sum.leaf_sizes.size()) sum.leaf_sizes.resize(size + std::size_t{1});
    ++sum.leaf_sizes[size];
    ++level.leaves;
    sum.triangles += size;
    sum.mean_depth += visit.depth;
  };
  const auto mean = [](double total, std::uint64_t count) {
    return count == 0 ? 0 : total / static_cast<double>(count);
  };
  return visit_tree(tree, per_node, [&] {
    for (TreeLevel& level : sum.levels) {
      sum.nodes += level.nodes;
      sum.leaves += level.leaves;
      sum.overlap += level.overlap;
      level.overlap = mean(level.overlap, level.nodes - level.leaves);
    }
    sum.max_depth = sum.levels.empty() ? 0 : static_cast<std::uint32_t>(sum.levels.size() - 1);
    sum.mean_depth = mean(sum.mean_depth, sum.leaves);
    sum.overlap = mean(sum.overlap, sum.nodes - sum.leaves);
    sum.balance = balance_of(tree);
    return sum;
  });
}

}  // namespace pah
