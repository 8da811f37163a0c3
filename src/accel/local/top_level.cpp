#include "accel/local/top_level.hpp"

#include <algorithm>
#include <utility>

namespace pah {
namespace {

struct Cell {
  std::uint32_t node = 0;
  Aabb box;
  std::vector<AreaCandidate> candidates;

  [[nodiscard]] bool is_undecided() const {
    return !std::ranges::all_of(candidates, &AreaCandidate::certain);
  }
};

Vec3 middle(const Aabb& box) { return box.min + 0.5F * (box.max - box.min); }

// Bit k is set if the point is in the upper half along axis k. A point on the border counts as in
// the upper half; both halves' boxes include the border.
unsigned half_of(const Vec3& point, const Vec3& border) {
  unsigned half = 0;
  for (int k = 0; k < 3; ++k)
    if (point[k] >= border[k]) half |= 1U << static_cast<unsigned>(k);
  return half;
}

Aabb half_box(const Aabb& box, const Vec3& border, unsigned half) {
  Aabb result = box;
  for (int k = 0; k < 3; ++k) {
    const bool upper = (half >> static_cast<unsigned>(k) & 1U) != 0;
    (upper ? result.min : result.max)[k] = border[k];
  }
  return result;
}

}  // namespace

AreaList::AreaList(std::span<const Region> regions, std::span<const std::uint32_t> order) {
  boxes_.reserve(order.size());
  for (const std::uint32_t area : order) boxes_.push_back({enclosing_box(regions[area]), area});
}

AreaOctree::AreaOctree(std::span<const Region> regions, std::span<const std::uint32_t> order,
                       int depth) {
  constexpr int default_depth = 7;
  const bool set = depth > 0;
  const int last = set ? std::min(depth, deepest) : default_depth;
  std::vector<RegionShape> shapes;
  shapes.reserve(regions.size());
  for (const Region& region : regions) shapes.push_back(shape_of(region));

  Cell root;
  for (const std::uint32_t area : order) {
    box_.extend(shapes[area].box);
    root.candidates.push_back({area, false});
  }
  root.box = box_;
  nodes_.emplace_back();

  const auto settle = [&](const Cell& cell) {
    nodes_[cell.node] = {static_cast<std::uint32_t>(candidates_.size()),
                         static_cast<std::uint32_t>(cell.candidates.size())};
    candidates_.insert(candidates_.end(), cell.candidates.begin(), cell.candidates.end());
  };
  const auto child_of = [&](const Cell& cell, const Vec3& border, unsigned half) {
    Cell child{static_cast<std::uint32_t>(nodes_.size()), half_box(cell.box, border, half), {}};
    nodes_.emplace_back();
    for (const AreaCandidate& candidate : cell.candidates) {
      const std::uint32_t area = candidate.area;
      if (candidate.certain)
        child.candidates.push_back(candidate);
      else if (overlaps(shapes[area], child.box))
        child.candidates.push_back({area, contains(regions[area], child.box)});
    }
    return child;
  };

  std::vector<Cell> level;
  level.push_back(std::move(root));
  for (; !level.empty(); ++depth_) {
    std::vector<Cell> undecided, below;
    for (Cell& cell : level) {
      if (cell.is_undecided())
        undecided.push_back(std::move(cell));
      else
        settle(cell);
    }
    const bool full = !set && nodes_.size() + 8 * undecided.size() > default_max_nodes;
    if (depth_ == last || full || undecided.empty()) {
      for (const Cell& cell : undecided) settle(cell);
      break;
    }
    for (const Cell& cell : undecided) {
      nodes_[cell.node] = {static_cast<std::uint32_t>(nodes_.size()), inner};
      const Vec3 border = middle(cell.box);
      for (unsigned half = 0; half < 8; ++half) below.push_back(child_of(cell, border, half));
    }
    level = std::move(below);
  }
  nodes_.shrink_to_fit();
  candidates_.shrink_to_fit();
}

std::span<const AreaCandidate> AreaOctree::leaf_of(const Vec3& point) const {
  if (!contains(box_, point)) return {};
  Aabb box = box_;
  const Node* node = nodes_.data();
  while (node->count == inner) {
    const Vec3 border = middle(box);
    const unsigned half = half_of(point, border);
    box = half_box(box, border, half);
    node = &nodes_[node->first + half];
  }
  return std::span(candidates_).subspan(node->first, node->count);
}

}  // namespace pah
