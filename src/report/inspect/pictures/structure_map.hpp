// Colors each pixel by the structures that answer its shadow rays.
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

// The rays of a pixel lead from the point that its central ray meets to the center of each light
// that shines on it. The color is the mean over the structures that answer them, black without
// rays. Covers the whole picture, without a crop.
[[nodiscard]] StructureMap map_structures(const World& world, const Acceleration& acceleration,
                                          const FilmSettings& film);

}  // namespace pah
