// Finds the areas that hold a point, for rays without a bundle.
#pragma once

#include <cstdint>
#include <pah/geometry/region.hpp>
#include <span>
#include <variant>
#include <vector>

namespace pah {

// An area that may hold the points of a cell.
struct AreaCandidate {
  std::uint32_t area = 0;
  bool certain = false;  // the area holds the whole cell
};

// A list of the boxes around the areas.
class AreaList {
 public:
  // An area is named by its position in `regions`. `order` is the order in which areas are visited.
  AreaList(std::span<const Region> regions, std::span<const std::uint32_t> order);

  // Calls visit(candidate) for every area that holds the point, and for some that do not, until
  // visit returns true.
  template <typename Visit>
  void visit(const Vec3& point, const Visit& visit) const {
    for (const Boxed& boxed : boxes_)
      if (contains(boxed.box, point) && visit(AreaCandidate{boxed.area, false})) return;
  }
  [[nodiscard]] std::size_t memory_bytes() const { return boxes_.capacity() * sizeof(Boxed); }

 private:
  struct Boxed {
    Aabb box;
    std::uint32_t area;
  };
  std::vector<Boxed> boxes_;
};

// An octree around the areas. A cell is divided where an area's border runs through it; a leaf
// lists the areas that overlap it.
class AreaOctree {
 public:
  static constexpr int deepest = 10;
  // An octree whose depth is not set gets no further level beyond this many nodes, a megabyte.
  static constexpr std::size_t default_max_nodes = std::size_t{1} << 17U;

  // `depth` limits how often cells are halved, at most `deepest`; 0: as deep as 7 levels and
  // default_max_nodes allow.
  AreaOctree(std::span<const Region> regions, std::span<const std::uint32_t> order, int depth = 0);

  // As AreaList::visit().
  template <typename Visit>
  void visit(const Vec3& point, const Visit& visit) const {
    for (const AreaCandidate& candidate : leaf_of(point))
      if (visit(candidate)) return;
  }
  [[nodiscard]] std::span<const AreaCandidate> leaf_of(const Vec3& point) const;

  [[nodiscard]] std::size_t nodes() const { return nodes_.size(); }
  [[nodiscard]] int depth() const { return depth_; }
  [[nodiscard]] std::size_t memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + candidates_.capacity() * sizeof(AreaCandidate);
  }

 private:
  static constexpr std::uint32_t inner = 0xFFFFFFFFU;
  struct Node {
    std::uint32_t first = 0;  // the first of its eight children, or of its candidates
    std::uint32_t count = 0;  // the number of candidates, or `inner`
  };

  Aabb box_;
  std::vector<Node> nodes_;  // the root first
  std::vector<AreaCandidate> candidates_;
  int depth_ = 0;
};

using TopLevel = std::variant<std::monostate, AreaList, AreaOctree>;

}  // namespace pah
