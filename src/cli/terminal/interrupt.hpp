// Handling of Ctrl-C, SIGTERM and SIGHUP.
#pragma once

#include <atomic>

namespace pah::cli {

// Makes these signals end the program at once with exit code 130; SIGHUP only if it is not ignored.
void handle_interrupts();

// Makes writes to a closed pipe or a too large file fail instead of ending the program.
void outlive_failed_writes();

// During its lifetime the first signal only sets stop_requested(), so that the render can be saved.
// The second signal still ends the program at once.
class SavingOnInterrupt {
 public:
  SavingOnInterrupt();
  ~SavingOnInterrupt();
  SavingOnInterrupt(const SavingOnInterrupt&) = delete;
  SavingOnInterrupt& operator=(const SavingOnInterrupt&) = delete;
};

[[nodiscard]] const std::atomic<bool>& stop_requested();

// Requests a stop like the first signal does.
void request_stop();
void withdraw_stop();
// Returns whether a signal has requested a stop.
[[nodiscard]] bool signaled();

}  // namespace pah::cli
