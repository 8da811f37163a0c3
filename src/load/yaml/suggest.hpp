// "Did you mean ...?": finds the most similar of the valid names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pah {

// Returns the number of insertions, deletions, substitutions and swaps of neighbors that turn `a`
// into `b`: the restricted Damerau-Levenshtein distance.
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);

// Returns "; did you mean 'x'?" if a name is near enough, or "".
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& names);

// Returns the suggestion if there is one, or "; available keys are: ...".
[[nodiscard]] std::string suggestion_or_keys(std::string_view word,
                                             const std::vector<std::string>& keys);

// Returns "; did you mean 'x'? Available options are: ...", without the list if it is too long.
[[nodiscard]] std::string suggestion_and_options(std::string_view word,
                                                 const std::vector<std::string>& options);

}  // namespace pah
