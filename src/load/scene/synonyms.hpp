// Hints for keys of other programs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pah {

// Returns "; here it is 'intensity'" if `key` is another program's word for one of `known`, the
// keys of a map.
[[nodiscard]] std::string synonym_hint(std::string_view key, const std::vector<std::string>& known);

}  // namespace pah
