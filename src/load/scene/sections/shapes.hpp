// The shapes of the scene language.
#pragma once

#include <optional>
#include <pah/scene/shapes.hpp>

#include "load/scene/sections/reading.hpp"

namespace pah {

// In the order of Shape's alternatives.
[[nodiscard]] const std::vector<std::string>& shape_names();

// Reads the keys of the shape named shape_names()[index]. Reports an error and returns nothing if
// they are wrong or the shape needs more than `most_triangles`.
[[nodiscard]] std::optional<Shape> read_shape(SceneReading& reading, MapReader& map,
                                              std::size_t index, std::uint64_t most_triangles);

}  // namespace pah
