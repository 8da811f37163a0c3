#include "parallel/order.hpp"

namespace pah {

void ForkJoinOrder::fork() { forked_.fetch_add(1, std::memory_order_release); }
void ForkJoinOrder::begin_task() const { (void)forked_.load(std::memory_order_acquire); }
void ForkJoinOrder::end_task() { ended_.fetch_add(1, std::memory_order_release); }
void ForkJoinOrder::join() const { (void)ended_.load(std::memory_order_acquire); }

}  // namespace pah
