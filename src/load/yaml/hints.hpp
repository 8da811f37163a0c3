// What a mistake most likely is: for messages that say how to mend it.
#pragma once

#include <string>
#include <string_view>

#include "load/yaml/tree.hpp"

namespace pah {

// The mistake behind a fault that a parser has found in the text, at its own place if that can be
// told; else the fault as it is.
[[nodiscard]] YamlFault likely_fault(std::string_view text, const YamlFault& fault);

// "; a '#' after a blank begins a comment: ..." if the line has a color behind such a '#'.
[[nodiscard]] std::string comment_hint(std::string_view line);

// "; a blank is missing after the colon" if the word is a key and a value without one.
[[nodiscard]] std::string colon_hint(std::string_view word);

}  // namespace pah
