// Ctrl-C, SIGTERM and SIGHUP.
#pragma once

#include <atomic>

namespace pah::cli {

// From here on these signals end the program at once with exit code 130, unless they are ignored. A
// pipe that is closed or a file that is too large does not end it.
void handle_interrupts();

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

}  // namespace pah::cli
