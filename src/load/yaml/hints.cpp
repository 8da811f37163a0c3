#include "load/yaml/hints.hpp"

#include <cctype>
#include <optional>
#include <vector>

namespace pah {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

// Returns where in the line a comment begins that was probably meant as a color.
std::optional<std::size_t> color_as_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != 0) {
      if (line[i] == quote) quote = 0;
    } else if (line[i] == '"' || line[i] == '\'') {
      quote = line[i];
    } else if (line[i] == '#' && i > 0 && is_blank(line[i - 1])) {
      std::size_t digits = 0;
      while (i + 1 + digits < line.size() &&
             std::isxdigit(static_cast<unsigned char>(line[i + 1 + digits])) != 0)
        ++digits;
      if (digits == 3 || digits == 6) return i;
      return {};
    }
  }
  return {};
}

// Calls visit(line, number from 1) for the lines up to `last`, until it returns true.
template <class Visit>
void for_lines(std::string_view text, int last, const Visit& visit) {
  for (int number = 1; number <= last; ++number) {
    const std::size_t end = text.find('\n');
    if (visit(text.substr(0, end), number) || end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

// Returns the bracket that is not closed, or closed by one of another kind.
std::optional<YamlFault> open_bracket(std::string_view text) {
  std::vector<YamlFault> open;
  std::optional<YamlFault> wrong;
  char quote = 0;
  for_lines(text, 1'000'000, [&](std::string_view line, int number) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i];
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if ((c == '"' || c == '\'') &&
                 (i == 0 || is_blank(line[i - 1]) || line[i - 1] == '[' || line[i - 1] == '{' ||
                  line[i - 1] == ',')) {
        quote = c;
      } else if (c == '#' && (i == 0 || is_blank(line[i - 1]))) {
        break;
      } else if (c == '[' || c == '{') {
        open.push_back({{-1, number, static_cast<int>(i) + 1},
                        std::string("the '") + c + "' here is not closed"});
      } else if ((c == ']' || c == '}') && !open.empty()) {
        if (open.back().message[5] != (c == ']' ? '[' : '{')) {
          wrong = open.back();
          return true;
        }
        open.pop_back();
      }
    }
    return false;
  });
  if (!wrong && !open.empty()) wrong = open.back();
  return wrong;
}

std::size_t indent_of(std::string_view line) {
  const std::size_t indent = line.find_first_not_of(' ');
  return indent == std::string_view::npos ? line.size() : indent;
}

}  // namespace

std::string comment_hint(std::string_view line) {
  const auto at = color_as_comment(line);
  if (!at) return "";
  std::size_t end = *at + 1;
  while (end < line.size() && std::isxdigit(static_cast<unsigned char>(line[end])) != 0) ++end;
  return "; a '#' after a blank begins a comment: write \"" +
         std::string(line.substr(*at, end - *at)) + "\" in quotes";
}

std::string colon_hint(std::string_view word) {
  const std::size_t colon = word.find(':');
  const bool looks_like_it = colon != std::string_view::npos && colon > 0 &&
                             colon + 1 < word.size() && word[colon + 1] != '/' &&
                             word.find(' ') == std::string_view::npos;
  return looks_like_it ? "; a blank is missing after the colon" : "";
}

YamlFault likely_fault(std::string_view text, const YamlFault& fault) {
  YamlFault likely = fault;
  std::string_view line;
  std::string_view before;
  std::optional<YamlFault> found;
  for_lines(text, fault.mark.line, [&](std::string_view current, int number) {
    if (current.find_first_not_of(" \t\r") != std::string_view::npos) {
      before = line;
      line = current;
    }
    const std::size_t tab = current.find_first_not_of(' ');
    if (tab != std::string_view::npos && current[tab] == '\t' &&
        current.find_first_not_of(" \t\r") != std::string_view::npos)
      found = {{-1, number, static_cast<int>(tab) + 1},
               "lines are indented by spaces here, not by tabs"};
    else if (const auto color = color_as_comment(current))
      found = {{-1, number, static_cast<int>(*color) + 1},
               "not valid YAML" + comment_hint(current)};
    return found.has_value();
  });
  if (!found) found = open_bracket(text);
  if (found) {
    found->mark.override_index = fault.mark.override_index;
    return *found;
  }
  if (fault.message.find("unknown escape") != std::string::npos)
    likely.message = "in double quotes a backslash begins an escape: write / or use single quotes";
  else if (indent_of(line) > indent_of(before) && !before.empty())
    likely.message += "; is the line indented like those beside it?";
  return likely;
}

}  // namespace pah
