// Somewhere to put a mesh that comes without a scene.
#pragma once

#include <pah/scene/scene.hpp>

namespace pah {

// A floor under a bulb and a sun, with a camera that looks at two meters above its middle.
[[nodiscard]] Scene make_stage();

// Adds the mesh, two meters in its largest extent, in the middle of the floor. It needs an extent.
void put_on_stage(Scene& stage, Mesh mesh);

}  // namespace pah
