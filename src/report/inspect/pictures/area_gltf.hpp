// Influence areas, and the octree over them, as lines.
#pragma once

#include <pah/influence/top_level.hpp>
#include <pah/scene/areas.hpp>
#include <string>
#include <vector>

#include "accel/local/top_level.hpp"
#include "report/inspect/pictures/legend.hpp"
#include "report/inspect/pictures/line_set.hpp"

namespace pah {

// A color for each area.
[[nodiscard]] std::vector<LegendColor> area_legend(const std::vector<SceneArea>& areas);

// The edges of each area's region, in its color.
[[nodiscard]] std::vector<LineSet> area_lines(const std::vector<SceneArea>& areas);

// As a render has it whose areas these are, and whose top level is an octree.
[[nodiscard]] AreaOctree area_octree(const std::vector<SceneArea>& areas,
                                     const TopLevelConfig& config);

// The areas, and under a node "octree" the cells of its first `levels` levels, as a glTF file.
// `origin` is added to the coordinates.
[[nodiscard]] std::string areas_gltf(const std::vector<SceneArea>& areas, const AreaOctree& octree,
                                     std::uint32_t levels, const DVec3& origin);

}  // namespace pah
