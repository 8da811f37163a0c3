#include "io/mesh/limited_files.hpp"

#include <assimp/MemoryIOWrapper.h>

#include <cstring>
#include <system_error>

#include "io/mesh/folder.hpp"

namespace pah {

namespace fs = std::filesystem;

bool LimitedFiles::is_main(const fs::path& file) const {
  return file.lexically_normal() == main_.lexically_normal();
}

std::string LimitedFiles::reason_against(const fs::path& file) const {
  std::error_code error;
  if (is_main(file)) return "";
  if (!lies_in(file, folder_))
    return "it names '" + file.filename().string() + "' outside of its folder";
  if (!fs::is_regular_file(file, error)) return "";  // not there: for the importer to judge
  if (fs::file_size(file, error) > max_bytes_)
    return "it names '" + file.filename().string() + "', which is larger than " +
           std::to_string(max_bytes_ >> 20) + " MB";
  return "";
}

bool LimitedFiles::Exists(const char* file) const {
  const std::string reason = reason_against(file);
  if (!reason.empty() && refusal_.empty()) refusal_ = reason;
  return reason.empty() && DefaultIOSystem::Exists(file);
}

Assimp::IOStream* LimitedFiles::Open(const char* file, const char* mode) {
  std::error_code error;
  const bool writes = std::strpbrk(mode, "wa+") != nullptr;
  if (writes || !Exists(file) || !fs::is_regular_file(file, error)) return nullptr;
  if (is_main(file))
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(main_bytes_.data()),
                                      main_bytes_.size());
  return DefaultIOSystem::Open(file, mode);
}

}  // namespace pah
