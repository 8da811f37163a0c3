#include "report/inspect/pictures/legend.hpp"

#include <fmt/format.h>

#include <array>

#include "image/srgb.hpp"

namespace pah {
namespace {

struct NamedColor {
  std::string_view name;
  std::array<int, 3> encoded;  // sRGB
};

// Okabe & Ito, "Color Universal Design" (2008): color-blind people can tell these colors apart.
constexpr std::array<NamedColor, 8> colors{{{"gray", {128, 128, 128}},
                                            {"orange", {230, 159, 0}},
                                            {"sky blue", {86, 180, 233}},
                                            {"green", {0, 158, 115}},
                                            {"yellow", {240, 228, 66}},
                                            {"blue", {0, 114, 178}},
                                            {"vermilion", {213, 94, 0}},
                                            {"purple", {204, 121, 167}}}};

}  // namespace

LegendColor legend_color(std::string label, std::size_t index) {
  const NamedColor& named = colors[index == 0 ? 0 : 1 + (index - 1) % (colors.size() - 1)];
  LegendColor color{std::move(label), named.name};
  for (int i = 0; i < 3; ++i)
    color.color[i] =
        linear_from_srgb(static_cast<float>(named.encoded[static_cast<std::size_t>(i)]) / 255);
  return color;
}

std::string legend_text(const std::vector<LegendColor>& legend) {
  std::string text;
  for (const LegendColor& color : legend)
    text += fmt::format("  {:10}{}\n", color.name, color.label);
  return text;
}

}  // namespace pah
