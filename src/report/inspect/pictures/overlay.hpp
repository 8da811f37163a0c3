// Draws influence areas and boxes over the picture of their scene.
#pragma once

#include <pah/image/image.hpp>
#include <pah/render/acceleration.hpp>
#include <vector>

#include "report/inspect/pictures/line_set.hpp"

namespace pah {

// Renders the whole picture, without a crop, with few samples; exposed and clamped to [0, 1].
[[nodiscard]] Image draft_picture(const World& world, const Accelerator& accelerator,
                                  const Scene& settings);

// Draws `boxes` from the last to the first in thin lines, then `areas`.
void draw_over(Image& picture, const World& world, const Accelerator& accelerator,
               const FilmSettings& film, const std::vector<LineSet>& boxes,
               const std::vector<LineSet>& areas);

}  // namespace pah
