#include "load/yaml/suggest.hpp"

#include <algorithm>

namespace pah {
namespace {

constexpr std::size_t longest_word = 64;  // longer words are not compared
constexpr std::size_t longest_list = 24;

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the table suffice: a swap reaches two rows up.
  const std::size_t columns = b.size() + 1;
  std::vector<int> before(columns), above(columns), row(columns);
  for (std::size_t j = 0; j < columns; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < columns; ++j) {
      const int substituted = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, substituted});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

std::string suggestion(std::string_view word, const std::vector<std::string>& names) {
  if (word.size() > longest_word) return "";
  const std::string* nearest = nullptr;
  int least = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  for (const std::string& name : names) {
    if (name.size() > longest_word) continue;
    const int distance = edit_distance(word, name);
    if (distance < least) {
      least = distance;
      nearest = &name;
    }
  }
  return nearest == nullptr ? "" : "; did you mean '" + *nearest + "'?";
}

std::string suggestion_or_keys(std::string_view word, const std::vector<std::string>& keys) {
  const std::string near = suggestion(word, keys);
  return near.empty() && !keys.empty() ? "; available keys are: " + joined(keys) : near;
}

std::string suggestion_and_options(std::string_view word, const std::vector<std::string>& options) {
  std::string near = suggestion(word, options);
  if (options.empty() || options.size() > longest_list) return near;
  return (near.empty() ? "; available options are: " : near + " Available options are: ") +
         joined(options);
}

}  // namespace pah
