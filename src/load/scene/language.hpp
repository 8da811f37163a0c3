// The language of scenes, as described by the code that reads it.
#pragma once

#include "load/yaml/reader.hpp"

namespace pah {

// Returns every kind of map with its keys: "scene", "camera perspective", "mesh box", ...
[[nodiscard]] Language describe_language();

}  // namespace pah
