#pragma once

#include <algorithm>

namespace pah::cli {

// When to write a picture that is still rendered: at once, then as often as is asked for, but less
// often where writing would take more than a share of the time. All times are in seconds, by one
// clock.
class WriteSchedule {
 public:
  explicit WriteSchedule(double interval) : interval_(interval) {}

  [[nodiscard]] bool due(double now) const { return now >= next_; }
  void written(double began, double ended) {
    next_ = ended + std::max(interval_, (1 - share_) / share_ * (ended - began));
    share_ = 0.01;
  }

 private:
  double interval_;
  double next_ = 0;
  double share_ = 0.1;  // the first time takes longer: encoders are loaded, files are made
};

}  // namespace pah::cli
