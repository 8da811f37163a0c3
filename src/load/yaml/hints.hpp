// Guesses the mistake behind a fault, for messages that say how to fix it.
#pragma once

#include <string>
#include <string_view>

#include "load/yaml/tree.hpp"

namespace pah {

// Returns the likely mistake behind a fault of the parser, with its own place if that is known;
// else the fault itself.
[[nodiscard]] YamlFault likely_fault(std::string_view text, const YamlFault& fault);

// "; a '#' after a blank begins a comment: ..." if the line has a color behind such a '#'.
[[nodiscard]] std::string comment_hint(std::string_view line);

// "; a blank is missing after the colon" if the word is a key and a value without one.
[[nodiscard]] std::string colon_hint(std::string_view word);

}  // namespace pah
