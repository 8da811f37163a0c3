// Words, numbers and lines of mesh files that are text.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pah {

// The words of one line.
class Words {
 public:
  explicit Words(std::string_view line) : line_(line) {}

  // The next word; empty at the end of the line.
  std::string_view next();
  // From 1. The end of the line for an empty word.
  [[nodiscard]] int column_of(std::string_view word) const;

 private:
  std::string_view line_;
  std::size_t at_ = 0;
};

[[nodiscard]] bool is_blank(char c);

// Whether the word is a number that a float can hold.
[[nodiscard]] bool is_finite_number(std::string_view word);

// The line for an error message: not too long, and without control characters.
[[nodiscard]] std::string excerpt_of(std::string_view line);

}  // namespace pah
