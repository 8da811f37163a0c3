// Whether a scene's camera is shut in where no light comes.
#pragma once

#include <optional>
#include <pah/scene/scene.hpp>
#include <vector>

#include "scene/bounds.hpp"

namespace pah {

// The first instance that the camera is inside of, that is closed, and that neither holds a light
// nor lets any through. `boxes` are those of the instances.
[[nodiscard]] std::optional<std::size_t> dark_enclosure(const Scene& scene,
                                                        const std::vector<Bounds>& boxes);

}  // namespace pah
