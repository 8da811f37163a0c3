#include <pah/base/errors.hpp>
#include <utility>

namespace pah {
namespace {

// Replaces control characters: a terminal obeys them, and an excerpt may come from any file.
std::string printable(const std::string& text) {
  std::string result = text;
  for (char& c : result)
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == '\x7F') c = '?';
  return result;
}

// Returns the indent that puts a caret under the character at `column`. Tabs stay tabs.
std::string indent_to(const std::string& excerpt, int column) {
  std::string indent;
  int at = 0;
  for (const char c : excerpt) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0U) == 0x80;
    if (!continues && ++at >= column) break;
    if (!continues) indent += c == '\t' ? '\t' : ' ';
  }
  if (at < column) indent.append(static_cast<std::size_t>(column - 1 - at), ' ');
  return indent;
}

std::string format(const LocatedError& error, const char* noun) {
  const Location& at = error.where;
  std::string text = at.file;
  if (at.line > 0) text += ":" + std::to_string(at.line);
  if (at.line > 0 && at.column > 0) text += ":" + std::to_string(at.column);
  text += ": " + std::string(noun) + ": " + printable(error.message);
  if (error.excerpt.empty()) return text;
  text += "\n  " + printable(error.excerpt);
  const int caret = error.caret > 0 ? error.caret : at.column;
  if (caret > 0) text += "\n  " + indent_to(error.excerpt, caret) + "^";
  return text;
}

}  // namespace

std::string format_error(const LocatedError& error) { return format(error, "error"); }

std::string format_warning(const LocatedError& warning) { return format(warning, "warning"); }

SceneError::SceneError(std::vector<LocatedError> errors)
    : std::runtime_error(errors.empty() ? "error in the scene" : format_error(errors.front())),
      errors_(std::move(errors)) {}

}  // namespace pah
