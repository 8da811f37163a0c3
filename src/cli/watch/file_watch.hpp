// Detects changes of files by their sizes and modification times.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>

#include "base/file_stamp.hpp"

namespace pah::cli {

// Thread-safe.
class FileWatch {
 public:
  // Watches a file from its current state on, unless it is watched already. The file need not
  // exist.
  void watch(const std::filesystem::path& file);
  [[nodiscard]] bool changed() const;
  void accept_changes();
  void clear();

 private:
  mutable std::mutex mutex_;
  std::map<std::filesystem::path, FileStamp> files_;
};

}  // namespace pah::cli
