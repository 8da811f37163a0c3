// A scene as it is at one frame.
#pragma once

#include <optional>

#include "load/yaml/expression.hpp"
#include "load/yaml/reader.hpp"

namespace pah {

// The animation section; `frame` is the one of whoever loads, if any.
[[nodiscard]] FrameTime read_animation(ReadContext& context, const YamlNode* node,
                                       std::optional<int> frame);

// The tree with every keyframes at `now` in their place, and every text that is an expression with
// frame or time knowing its number. The same tree if there are none.
[[nodiscard]] YamlRef at_frame(ReadContext& context, const YamlRef& root, const FrameTime& now);

}  // namespace pah
