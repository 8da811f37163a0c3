// Reads words and numbers of text mesh files.
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
  // The remaining text of the line, without blanks around it.
  [[nodiscard]] std::string_view rest() const;
  // The word's column, from 1; the end of the line for an empty word.
  [[nodiscard]] int column_of(std::string_view word) const;

 private:
  std::string_view line_;
  std::size_t at_ = 0;
};

// Reads a decimal number as the nearest float; numbers below the smallest float become 0. Returns
// false if the word is no number or exceeds the range of floats.
[[nodiscard]] bool read_float(std::string_view word, float& value);

// Shortens a line for an error message and replaces control characters.
[[nodiscard]] std::string excerpt_of(std::string_view line);

// Removes a byte-order mark from the first line of a text.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view line);

}  // namespace pah
