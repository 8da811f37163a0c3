#include <pah/io/errors.hpp>
#include <utility>

namespace pah {

std::string format_error(const LocatedError& error) {
  const Location& at = error.where;
  std::string text = at.file;
  if (at.line > 0) text += ":" + std::to_string(at.line);
  if (at.line > 0 && at.column > 0) text += ":" + std::to_string(at.column);
  text += ": error: " + error.message;
  if (error.excerpt.empty()) return text;
  text += "\n  " + error.excerpt;
  if (at.column > 0)
    text += "\n  " + std::string(static_cast<std::size_t>(at.column - 1), ' ') + "^";
  return text;
}

SceneError::SceneError(std::vector<LocatedError> errors)
    : std::runtime_error(errors.empty() ? "error in the scene" : format_error(errors.front())),
      errors_(std::move(errors)) {}

}  // namespace pah
