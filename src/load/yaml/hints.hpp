// Guesses the mistake behind a fault, for messages that say how to fix it.
#pragma once

#include <string>
#include <string_view>

#include "load/yaml/tree.hpp"

namespace pah {

// Returns the likely mistake behind a fault of the parser, with its own place if that is known;
// else the fault itself.
[[nodiscard]] YamlFault likely_fault(std::string_view text, const YamlFault& fault);

// Returns "; a '#' after a blank begins a comment: ..." if the line has such a color, or "".
[[nodiscard]] std::string comment_hint(std::string_view line);

// Returns "; a blank is missing after the colon" if the word looks like "key:value", or "".
[[nodiscard]] std::string colon_hint(std::string_view word);

}  // namespace pah
