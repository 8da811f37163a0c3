// Whether files have changed, by their sizes and the times they were modified.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>

#include "base/file_stamp.hpp"

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
  mutable std::mutex mutex_;
  std::map<std::filesystem::path, FileStamp> files_;
};

}  // namespace pah::cli
