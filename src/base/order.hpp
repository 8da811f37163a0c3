// Tells the thread sanitizer that work before a fork and after a join does not race with the tasks.
// oneTBB orders them, but it is not compiled for the sanitizer, which would report false races.
#pragma once

#include <atomic>

namespace pah {

class ForkJoinOrder {
 public:
  // Lives while one task runs, also if the task throws.
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
  // Joins too: an exception of a task leaves the loop without calling join().
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
