#include "cli/terminal/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "cli/terminal/console.hpp"

namespace pah::cli {
namespace {

// Returns the width in characters. A longer line would wrap and could not be overwritten.
std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80U;
}

double fraction_of(const Progress& progress, const RenderGoal& goal) {
  const double time = goal.time_limit > 0 ? progress.seconds / goal.time_limit : 0;
  return std::clamp(std::max(progress.fraction, time), 0.0, 1.0);
}

std::string format_percentage(double fraction) {
  return fmt::format("{:.0f} %", std::floor(100 * fraction));
}

std::string format_time_left(const Progress& progress, double fraction) {
  return (fraction > 0 ? format_duration(progress.seconds * (1 / fraction - 1)) : "?") + " left";
}

}  // namespace

std::string format_progress(const Progress& progress, const RenderGoal& goal, std::size_t width) {
  const double fraction = fraction_of(progress, goal);
  const std::string percentage = format_percentage(fraction);
  const std::string left = format_time_left(progress, fraction);
  constexpr int bar_width = 20;
  const int filled = static_cast<int>(fraction * bar_width);
  std::string line = fmt::format("[{}{}] {}  {}, {}", std::string(filled, '#'),
                                 std::string(bar_width - filled, '.'), percentage,
                                 format_duration(progress.seconds), left);
  if (line.size() > width) return fmt::format("{}  {}", percentage, left).substr(0, width);
  for (const std::string& part :
       {fmt::format("  {}/{} samples", progress.samples_finished, goal.samples),
        "  " + format_ray_rate(progress.rays, progress.seconds)}) {
    if (line.size() + part.size() > width) break;
    line += part;
  }
  return line;
}

void ProgressBar::show(const Progress& progress) {
  if (progress.seconds < next_) return;
  next_ = progress.seconds + 0.1;
  say("\r" + format_progress(progress, goal_, terminal_width() - 1) + "\x1b[K");
}

void ProgressBar::wipe() { say("\r\x1b[K"); }

std::string Heartbeat::line(const Progress& progress) {
  const double fraction = fraction_of(progress, goal_);
  if (progress.seconds < next_ || fraction >= 1) return "";
  next_ = interval_ * (std::floor(progress.seconds / interval_) + 1);
  return fmt::format("{} after {}, {}\n", format_percentage(fraction),
                     format_duration(progress.seconds), format_time_left(progress, fraction));
}

}  // namespace pah::cli
