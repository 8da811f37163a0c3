#include "cli/watch/watch_command.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include "cli/render/frames.hpp"
#include "cli/terminal/console.hpp"
#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/report_exception.hpp"
#include "cli/watch/file_watch.hpp"

namespace pah::cli {
namespace {

constexpr std::chrono::milliseconds poll_interval(200);

// Stops the render when a file changes during its lifetime.
class StopOnChange {
 public:
  explicit StopOnChange(const FileWatch& files)
      : thread_([this, &files](const std::stop_token& ended) { poll(files, ended); }) {}

  [[nodiscard]] const std::atomic<bool>& changed() const { return changed_; }

 private:
  void poll(const FileWatch& files, const std::stop_token& ended) {
    std::mutex mutex;
    std::condition_variable_any wait;
    std::unique_lock lock(mutex);
    while (!wait.wait_for(lock, ended, poll_interval, [&] { return ended.stop_requested(); })) {
      if (!files.changed()) continue;
      changed_ = true;
      return request_stop();
    }
  }

  std::atomic<bool> changed_ = false;
  std::jthread thread_;  // last, because it uses the other members
};

void render_once(const RenderArguments& arguments, FileWatch& files, LoadedFiles& loaded,
                 bool first) {
  files.clear();
  files.watch(arguments.scene);
  const StopOnChange watcher(files);
  try {
    run_frames(arguments,
               {[&](const auto& file) { files.watch(file); }, &loaded, &watcher.changed()});
  } catch (const UsageError&) {
    if (first) throw;
    report_exception();
  } catch (...) {
    report_exception();
  }
}

// Waits a little longer, because editors may write a file in several steps.
void wait_for_change(FileWatch& files) {
  while (!files.changed()) std::this_thread::sleep_for(poll_interval);
  do {
    files.accept_changes();
    std::this_thread::sleep_for(poll_interval);
  } while (files.changed());
}

}  // namespace

ExitCode run_watch(const RenderArguments& arguments) {
  FileWatch files;
  LoadedFiles loaded;
  for (bool first = true;; first = false) {
    render_once(arguments, files, loaded, first);
    if (signaled()) return ExitCode::interrupted;
    withdraw_stop();
    if (!arguments.quiet && !files.changed())
      say(fmt::format("waiting for {} to change; Ctrl-C ends\n", arguments.scene.string()));
    wait_for_change(files);
  }
}

}  // namespace pah::cli
