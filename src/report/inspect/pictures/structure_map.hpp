// Which structure answers the shadow rays of each pixel, as colors.
#pragma once

#include <pah/image/image.hpp>
#include <pah/render/acceleration.hpp>
#include <vector>

#include "report/inspect/pictures/legend.hpp"

namespace pah {

struct StructureMap {
  Image image;
  std::vector<LegendColor> legend;
};

// Of the shadow rays from the point that a pixel's central ray meets, one to the center of each
// light that shines on it; where several structures answer them, the mean of their colors. Black
// where there are none. The whole picture, whatever its crop.
[[nodiscard]] StructureMap map_structures(const World& world, const Acceleration& acceleration,
                                          const FilmSettings& film);

}  // namespace pah
