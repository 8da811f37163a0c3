// Somewhere to put a mesh that comes without a scene.
#pragma once

#include <pah/scene/scene.hpp>

namespace pah {

// The mesh, two meters in its largest extent, on a floor under a bulb and a sun. It needs an
// extent.
[[nodiscard]] Scene staged(Mesh mesh);

}  // namespace pah
