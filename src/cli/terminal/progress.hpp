// How far a render is, while it goes on.
#pragma once

#include <cstddef>
#include <pah/render/render.hpp>
#include <string>

namespace pah::cli {

// Where a render ends: whichever comes first.
struct RenderGoal {
  int samples = 0;
  double time_limit = 0;  // seconds; 0: none
};

// A line, without its end, of as much as fits into so many characters.
[[nodiscard]] std::string format_progress(const Progress& progress, const RenderGoal& goal,
                                          std::size_t width);

// One line that is drawn over and over. Only make one where can_redraw().
class ProgressBar {
 public:
  explicit ProgressBar(const RenderGoal& goal) : goal_(goal) {}
  ~ProgressBar() { wipe(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  static void wipe();  // for something else to be said, until it is shown again

 private:
  RenderGoal goal_;
  double next_ = 0;  // seconds since the render began
};

// A line now and then, for logs.
class Heartbeat {
 public:
  explicit Heartbeat(const RenderGoal& goal, double interval = 10)
      : goal_(goal), interval_(interval), next_(interval) {}

  // What to say now: the next line, or nothing yet.
  [[nodiscard]] std::string line(const Progress& progress);

 private:
  RenderGoal goal_;
  double interval_;  // seconds
  double next_;      // seconds since the render began
};

}  // namespace pah::cli
