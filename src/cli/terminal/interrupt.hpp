// Ctrl-C, SIGTERM and SIGHUP.
#pragma once

#include <atomic>

namespace pah::cli {

// From here on they end the program at once with exit code 130; SIGHUP only if it is not ignored.
void handle_interrupts();

// From here on a pipe that is closed and a file that is too large make writing fail, no more.
void outlive_failed_writes();

// While one lives, the first signal only sets stop_requested(): there is something to save. The
// second still ends the program at once.
class SavingOnInterrupt {
 public:
  SavingOnInterrupt();
  ~SavingOnInterrupt();
  SavingOnInterrupt(const SavingOnInterrupt&) = delete;
  SavingOnInterrupt& operator=(const SavingOnInterrupt&) = delete;
};

[[nodiscard]] const std::atomic<bool>& stop_requested();

// Stops as the first signal does, without being one.
void request_stop();
void withdraw_stop();
// Whether a signal came that did not end the program at once.
[[nodiscard]] bool signaled();

}  // namespace pah::cli
