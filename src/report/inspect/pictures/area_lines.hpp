// Influence areas as lines.
#pragma once

#include <pah/scene/areas.hpp>
#include <vector>

#include "report/inspect/pictures/legend.hpp"
#include "report/inspect/pictures/line_set.hpp"

namespace pah {

// A color for each area.
[[nodiscard]] std::vector<LegendColor> area_legend(const std::vector<SceneArea>& areas);

// The edges of each area's region, in its color.
[[nodiscard]] std::vector<LineSet> area_lines(const std::vector<SceneArea>& areas);

}  // namespace pah
