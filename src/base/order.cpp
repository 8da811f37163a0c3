#include "base/order.hpp"

namespace pah {

ForkJoinOrder::Task::Task(ForkJoinOrder& order) : order_(order) {
  (void)order_.forked_.load(std::memory_order_acquire);
}
ForkJoinOrder::Task::~Task() { order_.ended_.fetch_add(1, std::memory_order_release); }

ForkJoinOrder::~ForkJoinOrder() { join(); }
void ForkJoinOrder::fork() { forked_.fetch_add(1, std::memory_order_release); }
void ForkJoinOrder::join() const { (void)ended_.load(std::memory_order_acquire); }

}  // namespace pah
