#include "io/mesh/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pah {

std::string excerpt_of(std::string_view line) {
  std::string text(line.substr(0, 120));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view Words::next() {
  while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
  const std::size_t begin = at_;
  while (at_ < line_.size() && !is_blank(line_[at_])) ++at_;
  return line_.substr(begin, at_ - begin);
}

int Words::column_of(std::string_view word) const {
  return static_cast<int>(word.data() - line_.data()) + 1;
}

bool is_finite_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  if (word.empty()) return false;
  // Digits that are few need no parsing.
  const bool plain = word.size() < 30 && std::all_of(word.begin(), word.end(), [](char c) {
                       return (c >= '0' && c <= '9') || c == '.' || c == '-';
                     });
  const bool starts_well = word.front() != '-' || word.size() > 1;
  if (plain && starts_well && word.find('-', 1) == std::string_view::npos &&
      word.find('.') == word.rfind('.') && word != "." && word != "-.")
    return true;
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return false;
  if (error == std::errc::result_out_of_range) {
    // Too small is as good as 0; too large is not.
    const std::size_t e = word.find_first_of("eE");
    return e != std::string_view::npos && e + 1 < word.size() && word[e + 1] == '-';
  }
  return error == std::errc{} && std::abs(value) <= 3.4028234e38;
}

}  // namespace pah
