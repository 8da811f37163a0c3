#include "cli/watch/file_watch.hpp"

#include <algorithm>

namespace pah::cli {

namespace fs = std::filesystem;

void FileWatch::watch(const fs::path& file) {
  const std::lock_guard lock(mutex_);
  files_.emplace(file, stamp_of(file));
}

bool FileWatch::changed() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(
      files_, [](const auto& entry) { return stamp_of(entry.first) != entry.second; });
}

void FileWatch::accept_changes() {
  const std::lock_guard lock(mutex_);
  for (auto& [file, stamp] : files_) stamp = stamp_of(file);
}

void FileWatch::clear() {
  const std::lock_guard lock(mutex_);
  files_.clear();
}

}  // namespace pah::cli
