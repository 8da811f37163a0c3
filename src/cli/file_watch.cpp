#include "cli/file_watch.hpp"

#include <algorithm>

namespace pah::cli {

namespace fs = std::filesystem;

FileWatch::State FileWatch::state_of(const fs::path& file) {
  std::error_code error;
  State state;
  state.size = fs::file_size(file, error);
  if (!error) state.modified = fs::last_write_time(file, error);
  if (error) return {};
  state.there = true;
  return state;
}

void FileWatch::watch(const fs::path& file) {
  const std::lock_guard lock(mutex_);
  files_.emplace(file, state_of(file));
}

bool FileWatch::changed() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(
      files_, [](const auto& entry) { return state_of(entry.first) != entry.second; });
}

void FileWatch::accept_changes() {
  const std::lock_guard lock(mutex_);
  for (auto& [file, state] : files_) state = state_of(file);
}

void FileWatch::clear() {
  const std::lock_guard lock(mutex_);
  files_.clear();
}

}  // namespace pah::cli
