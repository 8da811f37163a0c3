// Shows the progress of a render.
#pragma once

#include <cstddef>
#include <pah/render/render.hpp>
#include <string>

namespace pah::cli {

// The end of a render, whichever comes first.
struct RenderGoal {
  int samples = 0;
  double time_limit = 0;  // seconds; 0: none
};

// Formats a line without its end, as much as fits into the given width.
[[nodiscard]] std::string format_progress(const Progress& progress, const RenderGoal& goal,
                                          std::size_t width);

// A line that is redrawn in place. Requires can_redraw().
class ProgressBar {
 public:
  explicit ProgressBar(const RenderGoal& goal) : goal_(goal) {}
  ~ProgressBar() { wipe(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  static void wipe();  // clears the line for other messages

 private:
  RenderGoal goal_;
  double next_ = 0;  // seconds since the render began
};

// Prints a line from time to time, for logs.
class Heartbeat {
 public:
  explicit Heartbeat(const RenderGoal& goal, double interval = 10)
      : goal_(goal), interval_(interval), next_(interval) {}

  // Returns the next line if it is due, else an empty string.
  [[nodiscard]] std::string line(const Progress& progress);

 private:
  RenderGoal goal_;
  double interval_;  // seconds
  double next_;      // seconds since the render began
};

}  // namespace pah::cli
