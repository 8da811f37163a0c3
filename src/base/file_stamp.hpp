// Whether a file is as it was, by its size and the time it was modified.
#pragma once

#include <cstdint>
#include <filesystem>

namespace pah {

struct FileStamp {
  bool there = false;
  std::uintmax_t size = 0;
  std::filesystem::file_time_type modified;

  [[nodiscard]] bool operator==(const FileStamp&) const = default;
};

[[nodiscard]] FileStamp stamp_of(const std::filesystem::path& file);

}  // namespace pah
