// Ctrl-C and SIGTERM.
#pragma once

#include <atomic>

namespace pah::cli {

// From here on both signals end the program at once with exit code 130.
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
