#include "report/inspect/pictures/area_gltf.hpp"

#include <numeric>

#include "report/inspect/pictures/line_gltf.hpp"

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

AreaOctree area_octree(const std::vector<SceneArea>& areas, const TopLevelConfig& config) {
  std::vector<Region> regions;
  regions.reserve(areas.size());
  for (const SceneArea& area : areas) regions.push_back(region_of(area.area));
  std::vector<std::uint32_t> order(regions.size());
  std::iota(order.begin(), order.end(), 0U);
  return {regions, order, config.octree_depth};
}

std::string areas_gltf(const std::vector<SceneArea>& areas, const AreaOctree& octree,
                       std::uint32_t levels, const DVec3& origin) {
  LineGroup root{"influence areas", area_lines(areas), {}};
  LineGroup cells{"octree", level_lines(octree.cells(levels)), {}};
  if (!cells.sets.empty()) root.groups.push_back(std::move(cells));
  return lines_gltf(root, origin);
}

}  // namespace pah
