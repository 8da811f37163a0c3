// Which areas hold a point: asked of rays that carry no bundle.
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
  bool certain = false;  // it holds all of them
};

// The boxes around the areas, one after the other.
class AreaList {
 public:
  // `regions` are named by their positions; `order` is that in which they are visited.
  AreaList(std::span<const Region> regions, std::span<const std::uint32_t> order);

  // Calls visit(candidate) until it returns true, for every area that holds the point, among
  // others.
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

// Cells around the areas, halved along all axes where an area's border runs through them. A leaf
// lists the areas that overlap it.
class AreaOctree {
 public:
  static constexpr int deepest = 10;
  // Of an octree whose depth is not set: beyond so many nodes, a megabyte, no level is added.
  static constexpr std::size_t usual_nodes = std::size_t{1} << 17U;

  // `depth` is the number of times that the root may be halved, at most `deepest`; 0: as deep as
  // 7 levels and usual_nodes allow.
  AreaOctree(std::span<const Region> regions, std::span<const std::uint32_t> order, int depth = 0);

  // As AreaList::visit().
  template <typename Visit>
  void visit(const Vec3& point, const Visit& visit) const {
    for (const AreaCandidate& candidate : leaf_of(point))
      if (visit(candidate)) return;
  }
  [[nodiscard]] std::span<const AreaCandidate> leaf_of(const Vec3& point) const;

  // The boxes of the first `levels` levels' cells, halved ones too; none if there are no areas.
  [[nodiscard]] std::vector<std::vector<Aabb>> cells(std::size_t levels) const;

  [[nodiscard]] std::size_t nodes() const { return nodes_.size(); }
  [[nodiscard]] int depth() const { return depth_; }
  [[nodiscard]] std::size_t memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + candidates_.capacity() * sizeof(AreaCandidate);
  }

 private:
  static constexpr std::uint32_t inner = 0xFFFFFFFFU;
  struct Node {
    std::uint32_t first = 0;  // of its eight children, or of its candidates
    std::uint32_t count = 0;  // of these, or `inner`
  };

  Aabb box_;
  std::vector<Node> nodes_;  // the root first
  std::vector<AreaCandidate> candidates_;
  int depth_ = 0;
};

using TopLevel = std::variant<std::monostate, AreaList, AreaOctree>;

}  // namespace pah
