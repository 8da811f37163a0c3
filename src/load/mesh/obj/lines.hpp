// Splits the text of an OBJ file into lines and statements.
#pragma once

#include <string_view>

namespace pah {

// Elements have the order of their indices in a corner.
enum class ObjStatement { other, position, uv, normal, face };

[[nodiscard]] ObjStatement obj_statement(std::string_view keyword);

class ObjLines {
 public:
  // `text` begins with a statement and follows `lines_before` lines of its file.
  ObjLines(std::string_view text, char line_end, int lines_before)
      : left_(text), line_end_(line_end), number_(lines_before) {}

  // Goes to the next line; returns false at the end of the text.
  bool next();

  // The line without trailing blanks and backslash.
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] int number() const { return number_; }   // from 1
  [[nodiscard]] bool begins() const { return begins_; }  // is it the first line of a statement?
  [[nodiscard]] bool ends() const { return ends_; }

 private:
  std::string_view left_;
  char line_end_;
  int number_;
  std::string_view text_;
  bool begins_ = true;
  bool ends_ = true;
};

}  // namespace pah
