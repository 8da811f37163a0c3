// Chooses the origin of world coordinates, and finds meshes that are too far from it.
#pragma once

#include <pah/scene/camera.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/bounds.hpp"

namespace pah {

// Returns the center of the boxes of all instances. If a box would lose visible precision there,
// returns the camera's position or target if that loses less.
[[nodiscard]] DVec3 choose_origin(const Camera& camera, std::span<const Bounds> boxes);

// Returns whether floats relative to `origin` are too coarse for the shape in the box.
[[nodiscard]] bool loses_shape(const Bounds& box, const DVec3& origin);

}  // namespace pah
