#include "cli/terminal/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace pah::cli {

void say(const std::string& text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

bool can_redraw() {
  const char* const kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && (kind == nullptr || std::string_view(kind) != "dumb");
}

std::string format_duration(double seconds) {
  if (!(seconds >= 9.95)) return fmt::format("{:.1f} s", seconds);
  const auto whole = std::llround(std::min(seconds, 1e12));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string format_ray_rate(std::uint64_t rays, double seconds) {
  const double rate = seconds > 0 ? static_cast<double>(rays) / seconds : 0;
  if (rate >= 1e6) return fmt::format("{:.1f} Mrays/s", rate / 1e6);
  if (rate >= 1e3) return fmt::format("{:.1f} krays/s", rate / 1e3);
  return fmt::format("{:.0f} rays/s", rate);
}

}  // namespace pah::cli
