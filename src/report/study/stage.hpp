// A scene for meshes that have none.
#pragma once

#include <pah/scene/scene.hpp>

namespace pah {

// Makes a floor under a bulb and a sun, and a camera that looks at a point two meters above the
// floor's middle.
[[nodiscard]] Scene make_stage();

// Adds the mesh in the middle of the floor, scaled to a largest extent of two meters. Its extent
// must not be zero.
void put_on_stage(Scene& stage, Mesh mesh);

}  // namespace pah
