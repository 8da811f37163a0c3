// Whether files have changed, by their sizes and the times they were modified.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>

namespace pah::cli {

// May be used by several threads at once.
class FileWatch {
 public:
  // From how it is now, unless it is watched already; it need not be there.
  void watch(const std::filesystem::path& file);
  [[nodiscard]] bool changed() const;
  void accept_changes();
  void clear();

 private:
  struct State {
    bool there = false;
    std::uintmax_t size = 0;
    std::filesystem::file_time_type modified;

    [[nodiscard]] bool operator==(const State&) const = default;
  };
  static State state_of(const std::filesystem::path& file);

  mutable std::mutex mutex_;
  std::map<std::filesystem::path, State> files_;
};

}  // namespace pah::cli
