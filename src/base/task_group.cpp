#include "base/task_group.hpp"

#include <tbb/task_group.h>

#include "base/order.hpp"

namespace pah {

struct TaskGroup::Impl {
  tbb::task_group tasks;
  ForkJoinOrder order;
};

TaskGroup::TaskGroup() : impl_(std::make_unique<Impl>()) {}
TaskGroup::~TaskGroup() = default;

void TaskGroup::run(std::function<void()> task) {
  impl_->order.fork();
  impl_->tasks.run([this, task = std::move(task)] {
    const ForkJoinOrder::Task here(impl_->order);
    task();
  });
}

void TaskGroup::wait() {
  impl_->tasks.wait();
  impl_->order.join();
}

}  // namespace pah
