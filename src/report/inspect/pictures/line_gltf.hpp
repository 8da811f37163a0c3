// Lines as a glTF 2.0 file for any viewer.
#pragma once

#include <string>
#include <vector>

#include "report/inspect/pictures/line_set.hpp"

namespace pah {

struct LineGroup {
  std::string name;
  std::vector<LineSet> sets;  // each with lines
  std::vector<LineGroup> groups;
};

// A node for each group and set, so that viewers can switch them off; a mesh and a color for each
// set. `origin` is added to the coordinates.
[[nodiscard]] std::string lines_gltf(const LineGroup& root, const DVec3& origin);

}  // namespace pah
