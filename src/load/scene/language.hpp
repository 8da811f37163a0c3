// The language of scenes, told by the code that reads it.
#pragma once

#include "load/yaml/reader.hpp"

namespace pah {

// Every kind of map with its keys: "scene", "camera perspective", "mesh box", ...
[[nodiscard]] Language describe_language();

}  // namespace pah
