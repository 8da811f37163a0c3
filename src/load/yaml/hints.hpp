// Guesses the cause of a mistake, so that messages can say how to fix it.
#pragma once

#include <string>
#include <string_view>

#include "load/yaml/tree.hpp"

namespace pah {

// Returns the likely cause of a parser's fault, at the place of the cause, or the fault itself if
// no cause is known.
[[nodiscard]] YamlFault likely_fault(std::string_view text, const YamlFault& fault);

// Returns "; a '#' after a blank begins a comment: ..." if the line has such a color, or "".
[[nodiscard]] std::string comment_hint(std::string_view line);

// Returns "; a blank is missing after the colon" if the word looks like "key:value", or "".
[[nodiscard]] std::string colon_hint(std::string_view word);

}  // namespace pah
