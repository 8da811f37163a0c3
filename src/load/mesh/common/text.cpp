#include "load/mesh/common/text.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pah {
namespace {

// The powers of ten that a double holds exactly.
constexpr double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int largest_power = 22;
constexpr int most_digits = 19;  // that fit 64 bits

// digits * 10^exponent, without the sign.
struct Decimal {
  std::uint64_t digits = 0;
  int count = 0;  // digits after leading zeros; above most_digits, `digits` has overflowed
  int exponent = 0;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Reads [+|-]digits[.digits][(e|E)[+|-]digits], with digits on either side of the point.
bool read_decimal(const char* at, const char* end, Decimal& number) {
  // Returns the number of digits.
  const auto take_digits = [&] {
    const char* const first = at;
    if (number.count == 0)
      while (at < end && *at == '0') ++at;
    const char* const significant = at;
    for (; at < end && is_digit(*at); ++at)
      number.digits = 10 * number.digits + static_cast<std::uint64_t>(*at - '0');
    number.count += static_cast<int>(at - significant);
    return static_cast<int>(at - first);
  };
  bool any = take_digits() > 0;
  if (at < end && *at == '.') {
    ++at;
    number.exponent = -take_digits();
    any |= number.exponent < 0;
  }
  if (!any) return false;
  if (at < end && (*at == 'e' || *at == 'E')) {
    ++at;
    const bool negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) ++at;
    if (at == end) return false;
    int exponent = 0;
    for (; at < end && is_digit(*at); ++at)
      if (exponent < 100'000'000) exponent = 10 * exponent + (*at - '0');
    number.exponent += negative ? -exponent : exponent;
  }
  return at == end;
}

// Correctly rounded twice is correctly rounded once, unless the double lies half-way between two
// floats (Clinger, "How to Read Floating Point Numbers Accurately", PLDI 1990, for the double).
bool round_fast(const Decimal& number, float& value) {
  const int power = std::abs(number.exponent);
  if (number.count > most_digits || number.digits > 1ULL << 53 || power > largest_power)
    return false;
  const auto digits = static_cast<double>(number.digits);
  const double exact =
      number.exponent < 0 ? digits / powers_of_ten[power] : digits * powers_of_ten[power];
  constexpr std::uint64_t dropped = (1ULL << 29) - 1;  // bits of a double that a float lacks
  const bool half_way = (std::bit_cast<std::uint64_t>(exact) & dropped) == 1ULL << 28;
  if (half_way || (exact < std::numeric_limits<float>::min() && exact != 0)) return false;
  value = static_cast<float>(exact);
  return true;
}

}  // namespace

std::string excerpt_of(std::string_view line) {
  std::string text(line.substr(0, 120));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

std::string_view without_byte_order_mark(std::string_view line) {
  return line.substr(0, 3) == "\xEF\xBB\xBF" ? line.substr(3) : line;
}

std::string_view Words::rest() const {
  std::string_view text = line_.substr(at_);
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

int Words::column_of(std::string_view word) const {
  return static_cast<int>(word.data() - line_.data()) + 1;
}

bool read_float(std::string_view word, float& value) {
  const bool negative = !word.empty() && word.front() == '-';
  if (negative || (!word.empty() && word.front() == '+')) word.remove_prefix(1);
  const char* const begin = word.data();
  const char* const end = begin + word.size();
  Decimal number;
  if (!read_decimal(begin, end, number)) return false;
  if (!round_fast(number, value)) {
    const std::errc error = std::from_chars(begin, end, value).ec;
    if (error == std::errc::result_out_of_range) {
      if (number.count + number.exponent > 0) return false;
      value = 0;
    }
  }
  if (negative) value = -value;
  return std::isfinite(value);
}

}  // namespace pah
