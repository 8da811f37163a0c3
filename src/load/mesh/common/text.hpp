// Words and numbers of mesh files in text formats.
#pragma once

#include <string>
#include <string_view>

namespace pah {

[[nodiscard]] inline bool is_blank(char c) {
  // Most characters need only the first comparison.
  return static_cast<unsigned char>(c) <= ' ' && (c == ' ' || c == '\t' || c == '\r');
}

// The words of one line.
class Words {
 public:
  explicit Words(std::string_view line) : line_(line) {}

  // The next word; empty at the end of the line.
  std::string_view next() {
    while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < line_.size() && !is_blank(line_[at_])) ++at_;
    return line_.substr(begin, at_ - begin);
  }
  // Returns the remaining text without blanks around it.
  [[nodiscard]] std::string_view rest() const;
  // Counts from 1. An empty word from next() is at the end of the line.
  [[nodiscard]] int column_of(std::string_view word) const;

 private:
  std::string_view line_;
  std::size_t at_ = 0;
};

// Parses a decimal number and rounds it to the nearest float; tiny numbers become 0. Returns false
// if the word is not a number or too large.
[[nodiscard]] bool read_float(std::string_view word, float& value);

// Shortens a line for an error message and replaces control characters.
[[nodiscard]] std::string excerpt_of(std::string_view line);

// Removes the byte order mark that the first line of a text may have.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view line);

}  // namespace pah
