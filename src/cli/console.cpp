#include "cli/console.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pah::cli {

void say(const std::string& text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
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

namespace {

// In characters; a longer line would wrap, and could not be drawn over.
std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80U;
}

}  // namespace

bool ProgressBar::possible() { return ::isatty(STDERR_FILENO) == 1; }

void ProgressBar::show(const Progress& progress) {
  if (progress.seconds < next_) return;
  next_ = progress.seconds + 0.1;
  constexpr int bar_width = 20;
  const int filled = std::clamp(static_cast<int>(progress.fraction * bar_width), 0, bar_width);
  const std::string left =
      progress.fraction > 0 ? format_duration(progress.seconds * (1 / progress.fraction - 1)) : "?";
  std::string line =
      fmt::format("[{}{}] {:.0f} %  {}, {} left  {}/{} samples  {}", std::string(filled, '#'),
                  std::string(bar_width - filled, '.'), std::floor(100 * progress.fraction),
                  format_duration(progress.seconds), left, progress.samples_finished, samples_,
                  format_ray_rate(progress.rays, progress.seconds));
  line.resize(std::min(line.size(), terminal_width() - 1));
  say("\r" + line + "\x1b[K");
}

ProgressBar::~ProgressBar() { say("\r\x1b[K"); }

}  // namespace pah::cli
