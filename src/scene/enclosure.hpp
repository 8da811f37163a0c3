// Detects a camera inside a closed object that no light enters.
#pragma once

#include <optional>
#include <pah/scene/scene.hpp>
#include <vector>

#include "scene/bounds.hpp"

namespace pah {

// Returns the first closed instance around the camera that holds no light and lets none through.
// `boxes` are the bounding boxes of the instances.
[[nodiscard]] std::optional<std::size_t> dark_enclosure(const Scene& scene,
                                                        const std::vector<Bounds>& boxes);

}  // namespace pah
