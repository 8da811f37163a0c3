// Numbers that depend on the frame: "15 * frame", "2 + sin(90 * time)".
//
//   sum     = product {("+" | "-") product}
//   product = factor {("*" | "/" | "%") factor}
//   factor  = ("+" | "-") factor | number | "frame" | "time" | ["sin" | "cos" | "abs" | "floor"]
//             "(" sum ")"
//
// Angles are in degrees. a % b is in [0, b), whatever the sign of a.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pah {

struct FrameTime {
  double frame = 0;
  double time = 0;  // seconds
};

// Returns the value, which may be infinite or NaN, or nothing if the text is not an expression.
[[nodiscard]] std::optional<double> evaluate(std::string_view text, const FrameTime& now);

// Returns the unknown name if the text would be an expression without it.
[[nodiscard]] std::string unknown_name_in(std::string_view text);

// The names of all variables and functions.
[[nodiscard]] const std::vector<std::string>& expression_names();

}  // namespace pah
