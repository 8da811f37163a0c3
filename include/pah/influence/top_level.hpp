// The top level finds the influence areas that hold a ray's origin.
#pragma once

#include <cstdint>
#include <numbers>
#include <pah/base/enum_names.hpp>

namespace pah {

// The structure that finds the areas of a ray without a bundle (thesis, 3.3 and 5.5).
enum class TopLevelKind : std::uint8_t {
  none,   // such rays are traced through the global BVH
  list,   // a list of the boxes around all areas
  octree  // cells that list the areas which overlap them
};
inline constexpr EnumName<TopLevelKind> top_level_names[]{
    {TopLevelKind::none, "none", "none"},
    {TopLevelKind::list, "list", "list"},
    {TopLevelKind::octree, "octree", "octree"}};

struct TopLevelConfig {
  TopLevelKind kind = TopLevelKind::none;
  // How often the octree's cells are halved, 1 to 10; 0: up to 7 times within a megabyte of nodes.
  int octree_depth = 0;
  // An area is asked only for rays that run along its bundle's rays up to this angle in radians.
  // The top level changes speed, never an answer.
  double direction_tolerance = std::numbers::pi / 36;
};

}  // namespace pah
