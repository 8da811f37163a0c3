#include "io/mesh_file_access.hpp"

#include <algorithm>
#include <cstring>
#include <system_error>

namespace pah {
namespace {

namespace fs = std::filesystem;

fs::path whole(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  return (error ? path : absolute).lexically_normal();
}

}  // namespace

bool lies_in(const fs::path& file, const fs::path& folder) {
  const fs::path relative = whole(file).lexically_relative(whole(folder));
  return !relative.empty() && *relative.begin() != "..";
}

fs::path folder_of(const fs::path& file, const fs::path& folder) {
  return folder.empty() ? whole(file).parent_path() : folder;
}

std::string LimitedFiles::reason_against(const fs::path& file) const {
  std::error_code error;
  if (whole(file) == whole(main_)) return "";
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
  const bool reads = std::strchr(mode, 'w') == nullptr && std::strchr(mode, 'a') == nullptr;
  return reads && Exists(file) && fs::is_regular_file(file, error)
             ? DefaultIOSystem::Open(file, mode)
             : nullptr;
}

}  // namespace pah
