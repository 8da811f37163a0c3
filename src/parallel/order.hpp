// What comes before a fork and after a join. oneTBB orders both, but is not compiled for the thread
// sanitizer, which would report races where there are none.
#pragma once

#include <atomic>

namespace pah {

class ForkJoinOrder {
 public:
  void fork();
  void begin_task() const;
  void end_task();
  void join() const;

 private:
  std::atomic<unsigned> forked_ = 0;
  std::atomic<unsigned> ended_ = 0;
};

}  // namespace pah
