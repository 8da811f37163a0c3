#include "load/yaml/error_collector.hpp"

#include <algorithm>
#include <tuple>

#include "load/yaml/hints.hpp"

namespace pah {
namespace {

constexpr std::size_t most_errors = 100;
constexpr std::size_t longest_excerpt = 160;  // bytes
constexpr std::size_t shown_before = 60;      // bytes before the caret

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80; }

int characters(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

}  // namespace

LocatedError ErrorCollector::locate(const YamlFault& error, std::string_view line) const {
  const Mark& mark = error.mark;
  if (mark.override_index >= 0)
    return {{"-D " + overrides_[static_cast<std::size_t>(mark.override_index)]}, error.message, ""};
  if (mark.line <= 0) return {{file_}, error.message, ""};
  const std::size_t at =
      std::min(static_cast<std::size_t>(std::max(mark.column, 1) - 1), line.size());
  std::size_t first = 0;
  if (line.size() > longest_excerpt && at > shown_before) first = at - shown_before;
  while (first > 0 && continues(line[first])) --first;
  std::size_t last = std::min(line.size(), first + longest_excerpt);
  while (last < line.size() && continues(line[last])) ++last;
  const bool is_missing = error.message.ends_with("not nothing");
  return {{file_, mark.line, characters(line.substr(0, at)) + 1},
          error.message + (is_missing ? comment_hint(line) : ""),
          std::string(line.substr(first, last - first)),
          characters(line.substr(first, at - first)) + 1};
}

std::vector<LocatedError> ErrorCollector::located(std::vector<YamlFault> faults,
                                                  const char* noun) const {
  // Errors of the file come first, then errors of the overrides in order.
  const auto key = [](const YamlFault& e) {
    return std::tie(e.mark.override_index, e.mark.line, e.mark.column);
  };
  std::stable_sort(faults.begin(), faults.end(),
                   [&](const YamlFault& a, const YamlFault& b) { return key(a) < key(b); });
  const auto same = [&](const YamlFault& a, const YamlFault& b) {
    return key(a) == key(b) && a.message == b.message;
  };
  faults.erase(std::unique(faults.begin(), faults.end(), same), faults.end());

  std::vector<LocatedError> result;
  int line_number = 1;
  std::size_t start = 0;
  for (const YamlFault& error : faults) {
    if (result.size() == most_errors) break;
    while (line_number < error.mark.line && start < text_.size()) {
      const std::size_t end = text_.find('\n', start);
      start = end == std::string_view::npos ? text_.size() : end + 1;
      ++line_number;
    }
    std::string_view line = text_.substr(start, text_.find('\n', start) - start);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    result.push_back(locate(error, line));
  }
  if (faults.size() > most_errors) {
    LocatedError& remainder = result.emplace_back();
    remainder.where.file = file_;
    remainder.message = "and " + std::to_string(faults.size() - most_errors) + " more " + noun;
  }
  return result;
}

}  // namespace pah
