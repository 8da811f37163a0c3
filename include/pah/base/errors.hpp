// Errors in a user's files, with their place.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace pah {

// Where an error is: line and column count from 1, columns in characters; 0 means not known.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

struct LocatedError {
  Location where;
  std::string message;
  std::string excerpt;  // the line of text or, if that is long, a part of it; or empty
  int caret = 0;        // the excerpt's character to point at, from 1; 0 for where.column
};

// "file:line:column: error: message", then the excerpt and a caret under the column.
[[nodiscard]] std::string format_error(const LocatedError& error);
// The same with "warning".
[[nodiscard]] std::string format_warning(const LocatedError& warning);

// All errors of a scene file and of the files that it names.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<LocatedError> errors);
  [[nodiscard]] const std::vector<LocatedError>& errors() const { return errors_; }

 private:
  std::vector<LocatedError> errors_;
};

// A file that cannot be read or written; the scene itself may be right.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pah
