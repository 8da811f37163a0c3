#include "cli/terminal/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include "cli/terminal/exit_code.hpp"

namespace pah::cli {
namespace {

// Signal handlers may only use lock-free atomics.
static_assert(std::atomic<bool>::is_always_lock_free);
std::atomic<bool> saving{false};
std::atomic<bool> stop{false};
std::atomic<bool> received{false};

void on_signal(int) {
  if (!saving || received.exchange(true)) ::_exit(static_cast<int>(ExitCode::interrupted));
  stop = true;
}

}  // namespace

void handle_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  // nohup makes programs ignore SIGHUP.
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

void outlive_failed_writes() {
  struct sigaction action {};
  action.sa_handler = SIG_IGN;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaction(signal, &action, nullptr);
}

SavingOnInterrupt::SavingOnInterrupt() { saving = true; }
SavingOnInterrupt::~SavingOnInterrupt() { saving = false; }

const std::atomic<bool>& stop_requested() { return stop; }

void request_stop() { stop = true; }
void withdraw_stop() { stop = false; }
bool signaled() { return received; }

}  // namespace pah::cli
