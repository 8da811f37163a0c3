// Translates keys of other programs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pah {

// Returns "; here it is 'intensity'" if `known`, the keys of a map, has a synonym of `key`, or "".
[[nodiscard]] std::string synonym_hint(std::string_view key, const std::vector<std::string>& known);

}  // namespace pah
