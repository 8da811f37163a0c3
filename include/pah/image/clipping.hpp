// How much of a picture is brighter than a screen's white.
#pragma once

#include <pah/image/image.hpp>

namespace pah {

struct Clipping {
  double share = 0;     // of the pixels, those of a luminance above 1 at the exposure given
  double exposure = 0;  // in stops: where a twentieth of the pixels would be
};

// `exposure` in stops. Values that are not numbers count as black.
[[nodiscard]] Clipping measure_clipping(const Image& image, double exposure);

}  // namespace pah
