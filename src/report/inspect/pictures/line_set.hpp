// Regions of space as the lines along their edges.
#pragma once

#include <array>
#include <cstdint>
#include <pah/geometry/region.hpp>
#include <string>
#include <vector>

namespace pah {

struct LineSet {
  std::string name;
  Vec3 color{0};  // linear
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 2>> edges;  // between which positions
};

// Adds eight corners and all edges with a length; a frustum may start in a point.
void add_edges(const Region& region, LineSet& lines);

// Returns a set for each level, with its own color, which is visible on black and on white.
[[nodiscard]] std::vector<LineSet> level_lines(const std::vector<std::vector<Aabb>>& levels);

}  // namespace pah
