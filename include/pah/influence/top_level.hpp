// How rays are matched with the areas in which they start.
#pragma once

#include <cstdint>
#include <numbers>

namespace pah {

// How the areas that hold the origin of a ray without a bundle are found (thesis, 3.3 and 5.5).
enum class TopLevelKind : std::uint8_t {
  none,   // not at all: such rays are asked of the global BVH
  list,   // by the boxes around all areas
  octree  // by cells that list the areas which overlap them
};

struct TopLevelConfig {
  TopLevelKind kind = TopLevelKind::none;
  // How often the octree's cells are halved, 1 to 10; 0: as a megabyte of nodes allows, 7 at most.
  int octree_depth = 0;
  // Only rays that run along an area's rays, either way, up to so many radians are asked of it.
  // Like all of this it changes speed only.
  double direction_tolerance = std::numbers::pi / 36;
};

}  // namespace pah
