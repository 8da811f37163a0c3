// What comes before a fork and after a join. oneTBB orders both, but is not compiled for the thread
// sanitizer, which would report races where there are none.
#pragma once

#include <atomic>

namespace pah {

class ForkJoinOrder {
 public:
  // What is done by one task, to its end or to what it throws.
  class Task {
   public:
    explicit Task(ForkJoinOrder& order);
    ~Task();
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

   private:
    ForkJoinOrder& order_;
  };

  ForkJoinOrder() = default;
  // A join, too: what a task throws leaves the loop without another.
  ~ForkJoinOrder();
  ForkJoinOrder(const ForkJoinOrder&) = delete;
  ForkJoinOrder& operator=(const ForkJoinOrder&) = delete;

  void fork();
  void join() const;

 private:
  std::atomic<unsigned> forked_ = 0;
  std::atomic<unsigned> ended_ = 0;
};

}  // namespace pah
