// Tables in Markdown.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace pah {

// Escapes pipes, which would end a cell.
[[nodiscard]] inline std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

[[nodiscard]] inline std::string markdown_row(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

// Aligns all columns but the first to the right.
[[nodiscard]] inline std::string markdown_header(const std::vector<std::string>& cells) {
  std::vector<std::string> rule(cells.size(), "---:");
  rule.front() = "---";
  return markdown_row(cells) + markdown_row(rule);
}

}  // namespace pah
