#include "report/inspect/pictures/box_lines.hpp"

#include <pah/bvh/analyze.hpp>

namespace pah {

std::vector<LineSet> box_lines(const BinaryTree& tree, std::uint32_t count) {
  std::vector<std::vector<Aabb>> levels;
  const auto add = [&](const NodeVisit& visit) {
    if (visit.depth >= count) return;
    if (visit.depth == levels.size()) levels.emplace_back();
    levels[visit.depth].push_back(visit.node().box);
  };
  return visit_tree(tree, add, [&] { return level_lines(levels); });
}

}  // namespace pah
