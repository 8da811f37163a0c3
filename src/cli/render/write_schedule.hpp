#pragma once

#include <algorithm>

namespace pah::cli {

// Decides when to write an unfinished picture: at once, then at the given interval, or less often
// if writing would exceed a share of the time. All times are in seconds of one clock.
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
  double share_ = 0.1;  // the first write takes longer: it loads encoders and creates files
};

}  // namespace pah::cli
