// Notices that a file has changed by its size and its time of modification.
#pragma once

#include <cstdint>
#include <filesystem>

namespace pah {

struct FileStamp {
  bool exists = false;
  std::uintmax_t size = 0;
  std::filesystem::file_time_type modified;

  [[nodiscard]] bool operator==(const FileStamp&) const = default;
};

[[nodiscard]] FileStamp stamp_of(const std::filesystem::path& file);

}  // namespace pah
