// Evaluates an animated scene at one frame.
#pragma once

#include <optional>

#include "load/yaml/expression.hpp"
#include "load/yaml/reader.hpp"

namespace pah {

// Reads the animation section. `frame`, if given, replaces the frame of the section.
[[nodiscard]] FrameTime read_animation(ReadContext& context, const YamlNode* node,
                                       std::optional<int> frame);

// Returns the tree with keyframes replaced by their values at `now`, and with the numbers of
// expressions in frame or time. Returns the same tree if nothing is animated.
[[nodiscard]] YamlRef at_frame(ReadContext& context, const YamlRef& root, const FrameTime& now);

}  // namespace pah
