// Words and numbers of mesh files that are text.
#pragma once

#include <string>
#include <string_view>

namespace pah {

[[nodiscard]] inline bool is_blank(char c) {
  // One comparison for most characters.
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
  // All that is left, without blanks around it.
  [[nodiscard]] std::string_view rest() const;
  // From 1. The end of the line for an empty word.
  [[nodiscard]] int column_of(std::string_view word) const;

 private:
  std::string_view line_;
  std::size_t at_ = 0;
};

// Whether the word is a decimal number that a float can hold, and the float nearest to it. What is
// too small for one is 0.
[[nodiscard]] bool read_float(std::string_view word, float& value);

// The line for an error message: not too long, and without control characters.
[[nodiscard]] std::string excerpt_of(std::string_view line);

// A byte-order mark may stand before the first line of a text.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view line);

}  // namespace pah
