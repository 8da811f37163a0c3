// What became of the grids that lights may have, for people and for tools.
#pragma once

#include <cstdint>
#include <optional>
#include <pah/render/acceleration.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/json.hpp"

namespace pah {

// The grid of a light that shadow rays share a point or a direction of.
struct GridReport {
  std::string light;
  GridPlan plan;
  // Of those that were built.
  std::optional<double> build_seconds{};
  std::optional<std::uint64_t> bytes{};
  std::optional<GridLists> lists{};  // where the accelerator tells
};

[[nodiscard]] std::vector<GridReport> report_grids(const Acceleration& acceleration,
                                                   const World& world);

// One object a grid; a value that is not known is null.
[[nodiscard]] OrderedJson grids_json(const std::vector<GridReport>& grids);
// Some lines of what is known.
[[nodiscard]] std::string grid_text(const GridReport& grid);

}  // namespace pah
