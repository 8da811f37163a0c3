// Messages on stderr.
#pragma once

#include <cstdint>
#include <string>

namespace pah::cli {

// Prints to stderr at once; ignores a stderr that is closed or full.
void say(const std::string& text) noexcept;

// Returns whether stderr is a terminal that can move its cursor.
[[nodiscard]] bool can_redraw();

// Formats seconds: "4.2 s", "3:07", "2:03:07".
[[nodiscard]] std::string format_duration(double seconds);

// Formats a rate: "12.3 Mrays/s".
[[nodiscard]] std::string format_ray_rate(std::uint64_t rays, double seconds);

}  // namespace pah::cli
