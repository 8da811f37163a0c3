#include "base/file_stamp.hpp"

#include <system_error>

namespace pah {

FileStamp stamp_of(const std::filesystem::path& file) {
  std::error_code error;
  FileStamp stamp;
  stamp.size = std::filesystem::file_size(file, error);
  if (!error) stamp.modified = std::filesystem::last_write_time(file, error);
  if (error) return {};
  stamp.exists = true;
  return stamp;
}

}  // namespace pah
