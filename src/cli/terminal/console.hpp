// What the program says on stderr.
#pragma once

#include <cstdint>
#include <string>

namespace pah::cli {

// To stderr, at once; one that is closed or full is nobody's business.
void say(const std::string& text) noexcept;

// Whether stderr is a terminal that does more than print.
[[nodiscard]] bool can_redraw();

// "4.2 s", "3:07", "2:03:07".
[[nodiscard]] std::string format_duration(double seconds);

// "12.3 Mrays/s".
[[nodiscard]] std::string format_ray_rate(std::uint64_t rays, double seconds);

}  // namespace pah::cli
