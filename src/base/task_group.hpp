// A group of tasks. A task may run further tasks in the same group.
#pragma once

#include <functional>
#include <memory>

namespace pah {

class TaskGroup {
 public:
  TaskGroup();
  ~TaskGroup();  // wait() must have been called after the last run()

  void run(std::function<void()> task);
  // Waits until every task has ended; rethrows an exception of one of them.
  void wait();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pah
