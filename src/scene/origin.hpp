// Where world coordinates have their origin, and which meshes are too far from it.
#pragma once

#include <pah/scene/camera.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/bounds.hpp"

namespace pah {

// The center of all boxes, one for each instance, unless it is so far from some of them, for their
// size and for how large they are seen, that the camera or what it looks at is a better one.
[[nodiscard]] DVec3 choose_origin(const Camera& camera, std::span<const Bounds> boxes);

// Whether floats about `origin` are too coarse for the shape of what is in the box.
[[nodiscard]] bool loses_shape(const Bounds& box, const DVec3& origin);

}  // namespace pah
