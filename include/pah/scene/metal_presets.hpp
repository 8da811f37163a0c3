// Measured complex indices of refraction of metals.
#pragma once

#include <pah/geometry/vec.hpp>
#include <span>

namespace pah {

// Per channel, at 650, 550 and 450 nm: one wavelength stands for each primary.
struct MetalPreset {
  const char* name;     // the element's symbol
  const char* english;  // and its name
  Vec3 eta;
  Vec3 k;
};

[[nodiscard]] std::span<const MetalPreset> metal_presets();

}  // namespace pah
