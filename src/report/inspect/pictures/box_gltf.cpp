#include "report/inspect/pictures/box_gltf.hpp"

#include <pah/bvh/analyze.hpp>

#include "report/inspect/pictures/line_gltf.hpp"

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

std::string boxes_gltf(const BinaryTree& tree, std::uint32_t count, const DVec3& origin) {
  return lines_gltf({"BVH", box_lines(tree, count), {}}, origin);
}

}  // namespace pah
