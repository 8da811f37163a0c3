// What comes before a fork and after a join. oneTBB orders both; but its library is not compiled
// for the thread sanitizer, which would report races where there are none.
#pragma once

#include <atomic>

namespace pah {

class ForkJoinOrder {
 public:
  void fork() { forked_.store(true, std::memory_order_release); }
  void begin_task() const { (void)forked_.load(std::memory_order_acquire); }
  void end_task() { ended_.fetch_add(1, std::memory_order_release); }
  void join() const { (void)ended_.load(std::memory_order_acquire); }

 private:
  std::atomic<bool> forked_ = false;
  std::atomic<unsigned> ended_ = 0;
};

}  // namespace pah
