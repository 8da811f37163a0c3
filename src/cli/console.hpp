// What the program says on stderr.
#pragma once

#include <cstdint>
#include <pah/render/render.hpp>
#include <string>

namespace pah::cli {

// To stderr, at once; one that is closed or full is nobody's business.
void say(const std::string& text) noexcept;

// "4.2 s", "3:07", "2:03:07".
[[nodiscard]] std::string format_duration(double seconds);

// "12.3 Mrays/s".
[[nodiscard]] std::string format_ray_rate(std::uint64_t rays, double seconds);

// One line that is drawn over and over. Only make one where stderr is a terminal.
class ProgressBar {
 public:
  explicit ProgressBar(int samples) : samples_(samples) {}
  ~ProgressBar();  // wipes the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

  [[nodiscard]] static bool possible();

 private:
  int samples_;
  double next_ = 0;  // seconds since the render began
};

}  // namespace pah::cli
