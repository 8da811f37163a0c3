// The meaning of a picture's colors.
#pragma once

#include <pah/geometry/vec.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pah {

struct LegendColor {
  std::string label;
  std::string_view name;  // of the color
  Vec3 color{0};          // linear
};

// Index 0 is gray, for the usual case; other neighbors differ, and colors repeat.
[[nodiscard]] LegendColor legend_color(std::string label, std::size_t index);

// Returns a line for each color.
[[nodiscard]] std::string legend_text(const std::vector<LegendColor>& legend);

}  // namespace pah
