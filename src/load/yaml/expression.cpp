#include "load/yaml/expression.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace pah {
namespace {

constexpr int deepest = 64;  // nested parentheses and signs

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

class Parser {
 public:
  Parser(std::string_view text, const FrameTime& now) : text_(text), now_(now) {}

  std::optional<double> whole() {
    const double value = sum(0);
    skip_spaces();
    if (failed_ || at_ < text_.size()) return {};
    return value;
  }
  // The first unknown name. Parsing continues as if it were a variable.
  [[nodiscard]] const std::string& unknown() const { return unknown_; }

 private:
  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(char c) {
    skip_spaces();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  double fail() {
    failed_ = true;
    at_ = text_.size();
    return 0;
  }

  double sum(int depth) {
    double value = product(depth);
    while (!failed_) {
      if (take('+'))
        value += product(depth);
      else if (take('-'))
        value -= product(depth);
      else
        break;
    }
    return value;
  }

  double product(int depth) {
    double value = factor(depth);
    while (!failed_) {
      if (take('*')) {
        value *= factor(depth);
      } else if (take('/')) {
        value /= factor(depth);
      } else if (take('%')) {
        const double by = factor(depth);
        value -= by * std::floor(value / by);
      } else {
        break;
      }
    }
    return value;
  }

  double factor(int depth) {
    if (depth == deepest) return fail();
    if (take('-')) return -factor(depth + 1);
    if (take('+')) return factor(depth + 1);
    if (take('(')) return rest_of_parentheses(depth);
    if (at_ < text_.size() && is_letter(text_[at_])) return named(depth);
    double value = 0;
    const char* const end = text_.data() + text_.size();
    const auto [next, error] = std::from_chars(text_.data() + at_, end, value);
    if (error != std::errc()) return fail();
    at_ = static_cast<std::size_t>(next - text_.data());
    return value;
  }

  double rest_of_parentheses(int depth) {
    const double value = sum(depth + 1);
    return take(')') ? value : fail();
  }

  double named(int depth) {
    const std::size_t first = at_;
    while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
    const std::string_view name = text_.substr(first, at_ - first);
    if (name == "frame") return now_.frame;
    if (name == "time") return now_.time;
    const bool called = take('(');
    const double value = called ? rest_of_parentheses(depth) : 0;
    if (name == "sin" && called) return std::sin(glm::radians(value));
    if (name == "cos" && called) return std::cos(glm::radians(value));
    if (name == "abs" && called) return std::abs(value);
    if (name == "floor" && called) return std::floor(value);
    if (unknown_.empty()) unknown_ = name;
    return 0;
  }

  std::string_view text_;
  FrameTime now_;
  std::size_t at_ = 0;
  bool failed_ = false;
  std::string unknown_;
};

}  // namespace

std::optional<double> evaluate(std::string_view text, const FrameTime& now) {
  Parser parser(text, now);
  const std::optional<double> value = parser.whole();
  return parser.unknown().empty() ? value : std::nullopt;
}

std::string unknown_name_in(std::string_view text) {
  Parser parser(text, {});
  return parser.whole() ? parser.unknown() : "";
}

const std::vector<std::string>& expression_names() {
  static const std::vector<std::string> names{"frame", "time", "sin", "cos", "abs", "floor"};
  return names;
}

}  // namespace pah
