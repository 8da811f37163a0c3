// What keys of other programs are called here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pah {

// "; here it is 'intensity'" if one of `known`, the keys of a map, is what `key` is elsewhere.
[[nodiscard]] std::string synonym_hint(std::string_view key, const std::vector<std::string>& known);

}  // namespace pah
