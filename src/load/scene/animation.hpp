// Evaluates an animated scene at one frame.
#pragma once

#include <optional>

#include "load/yaml/expression.hpp"
#include "load/yaml/reader.hpp"

namespace pah {

// Reads the animation section; `frame` is the caller's, if given.
[[nodiscard]] FrameTime read_animation(ReadContext& context, const YamlNode* node,
                                       std::optional<int> frame);

// Returns the tree in which keyframes are replaced by their values at `now`, and expressions of
// frame or time know their values. Returns the same tree if there are none.
[[nodiscard]] YamlRef at_frame(ReadContext& context, const YamlRef& root, const FrameTime& now);

}  // namespace pah
