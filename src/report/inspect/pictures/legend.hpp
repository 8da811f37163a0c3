// What the colors of a picture mean.
#pragma once

#include <pah/geometry/vec.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pah {

struct LegendColor {
  std::string what;
  std::string_view name;  // of the color
  Vec3 color{0};          // linear
};

// 0 is gray, which is kept for what is usual; of the others, neighbors differ and some come again.
[[nodiscard]] LegendColor legend_color(std::string what, std::size_t index);

// A line for each color.
[[nodiscard]] std::string legend_text(const std::vector<LegendColor>& legend);

}  // namespace pah
