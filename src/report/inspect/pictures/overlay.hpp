// Influence areas and boxes drawn over the picture of their scene.
#pragma once

#include <pah/image/image.hpp>
#include <pah/render/acceleration.hpp>
#include <vector>

#include "report/inspect/pictures/line_set.hpp"

namespace pah {

// With few samples, and as PNG files show it: exposed, in [0, 1]. The whole picture, whatever its
// crop.
[[nodiscard]] Image draft_picture(const World& world, const Accelerator& accelerator,
                                  const Scene& settings);

// `boxes` from the last to the first, thin; then `areas`.
void draw_over(Image& picture, const World& world, const Accelerator& accelerator,
               const FilmSettings& film, const std::vector<LineSet>& boxes,
               const std::vector<LineSet>& areas);

}  // namespace pah
