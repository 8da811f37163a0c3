// Tasks that may run tasks of the same group.
#pragma once

#include <functional>
#include <memory>

namespace pah {

class TaskGroup {
 public:
  TaskGroup();
  ~TaskGroup();  // wait() must have been called after the last run()

  void run(std::function<void()> task);
  // Until every task has ended; rethrows what one of them threw.
  void wait();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pah
