// Reports on light grids, for people and for tools.
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

// The grid of a light whose shadow rays share a point or a direction.
struct GridReport {
  std::string light;
  GridPlan plan;
  // Set if the grid was built.
  std::optional<double> build_seconds{};
  std::optional<std::uint64_t> bytes{};
  std::optional<GridLists> lists{};  // if the accelerator counts them
};

[[nodiscard]] std::vector<GridReport> report_grids(const Acceleration& acceleration,
                                                   const World& world);

// Returns one object for each grid; unknown values are null.
[[nodiscard]] OrderedJson grids_json(const std::vector<GridReport>& grids);
// Returns some lines with the known values.
[[nodiscard]] std::string grid_text(const GridReport& grid);

}  // namespace pah
