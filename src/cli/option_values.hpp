// Parsers and validators of option values.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "cli/render/render_command.hpp"

namespace pah::cli {

// Parses "X0,X1,Y0,Y1", a rectangle that is not empty.
[[nodiscard]] std::optional<PixelRect> parse_crop(std::string_view text);

// Parses "FROM:TO", a range that is not empty, with TO at most 2^30.
[[nodiscard]] std::optional<IndexRange> parse_range(const std::string& text);
// Parses the same, or a single number.
[[nodiscard]] std::optional<IndexRange> parse_frames(const std::string& text);

[[nodiscard]] CLI::Validator finite_number(double low);
[[nodiscard]] CLI::Validator whole_number(int low, int high);
[[nodiscard]] CLI::Validator accelerator_name();

}  // namespace pah::cli
