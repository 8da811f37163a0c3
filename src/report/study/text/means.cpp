#include "report/study/text/means.hpp"

#include <algorithm>

namespace pah {

std::vector<CostRow> relative_costs(const std::vector<CostRow>& rows, const StudyVariant& base,
                                    double CostRow::*value) {
  std::vector<CostRow> relative = rows;
  for (CostRow& row : relative) {
    const auto same_area = std::ranges::find_if(rows, [&](const CostRow& other) {
      return base.built(other) && other.tree.mesh == row.tree.mesh &&
             other.tree.area == row.tree.area;
    });
    const double unit = same_area != rows.end() ? (*same_area).*value : 0;
    row.*value = unit > 0 ? row.*value / unit : 0;
  }
  return relative;
}

}  // namespace pah
