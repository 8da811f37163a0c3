#include "cli/option_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <pah/render/acceleration.hpp>
#include <vector>

namespace pah::cli {

std::optional<PixelRect> parse_crop(std::string_view text) {
  std::array<int, 4> bounds{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (i > 0 && (at == end || *at++ != ',')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, bounds[i]);
    if (error != std::errc{} || bounds[i] < 0) return std::nullopt;
    at = next;
  }
  const auto [x0, x1, y0, y1] = bounds;
  if (at != end || x0 >= x1 || y0 >= y1) return std::nullopt;
  return PixelRect{x0, x1, y0, y1};
}

std::optional<IndexRange> parse_range(const std::string& text) {
  IndexRange range;
  const char* const end = text.data() + text.size();
  const auto from = std::from_chars(text.data(), end, range.from);
  if (from.ec != std::errc{} || from.ptr == end || *from.ptr != ':') return std::nullopt;
  const auto to = std::from_chars(from.ptr + 1, end, range.to);
  if (to.ec != std::errc{} || to.ptr != end) return std::nullopt;
  if (range.from < 0 || range.from >= range.to || range.to > 1 << 30) return std::nullopt;
  return range;
}

std::optional<IndexRange> parse_frames(const std::string& text) {
  int frame = 0;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, frame);
  if (number.ec != std::errc{} || number.ptr != end) return parse_range(text);
  if (frame < 0 || frame >= 1 << 30) return std::nullopt;
  return IndexRange{frame, frame + 1};
}

CLI::Validator finite_number(double low) {
  return {[low](std::string& text) {
            double number = 0;
            if (CLI::detail::lexical_cast(text, number) && std::isfinite(number) && number >= low)
              return std::string();
            return fmt::format("{} is not a finite number{}", text,
                               std::isfinite(low) ? fmt::format(" >= {}", low) : "");
          },
          ""};
}

CLI::Validator whole_number(int low, int high) { return CLI::Range(low, high).description(""); }

CLI::Validator accelerator_name() {
  return {[](std::string& text) {
            if (std::ranges::find(accelerator_names(), text, &AcceleratorName::name) !=
                accelerator_names().end())
              return std::string();
            std::vector<std::string_view> names;
            for (const AcceleratorName& choice : accelerator_names()) names.push_back(choice.name);
            return fmt::format("unknown accelerator {}; available are {}", text,
                               fmt::join(names, ", "));
          },
          ""};
}

}  // namespace pah::cli
