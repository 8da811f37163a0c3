#include "report/inspect/pictures/area_lines.hpp"

namespace pah {

std::vector<LegendColor> area_legend(const std::vector<SceneArea>& areas) {
  std::vector<LegendColor> legend;
  legend.reserve(areas.size());
  for (const SceneArea& area : areas)
    legend.push_back(legend_color("area " + area.name, legend.size() + 1));
  return legend;
}

std::vector<LineSet> area_lines(const std::vector<SceneArea>& areas) {
  const std::vector<LegendColor> legend = area_legend(areas);
  std::vector<LineSet> sets;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    LineSet& set = sets.emplace_back();
    set.name = areas[i].name;
    set.color = legend[i].color;
    add_edges(region_of(areas[i].area), set);
  }
  return sets;
}

}  // namespace pah
