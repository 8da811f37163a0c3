// How much of a picture is brighter than a screen's white.
#pragma once

#include <pah/image/image.hpp>

namespace pah {

struct Clipping {
  double share = 0;     // of pixels whose luminance exceeds 1 at the given exposure
  double exposure = 0;  // stops; at this exposure a twentieth of the pixels would exceed 1
};

// `exposure` in stops. Values that are not numbers count as black.
[[nodiscard]] Clipping measure_clipping(const Image& image, double exposure);

}  // namespace pah
