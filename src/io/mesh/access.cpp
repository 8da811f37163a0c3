#include "io/mesh/access.hpp"

#include <assimp/MemoryIOWrapper.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

namespace pah {
namespace {

namespace fs = std::filesystem;

fs::path whole(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  return (error ? path : absolute).lexically_normal();
}

// The place of the line that begins the first material; the end if there is none.
std::size_t first_material(std::string_view text) {
  constexpr std::string_view keyword = "newmtl";
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t word = text.find_first_not_of(" \t", line);
    if (word == std::string_view::npos) break;
    if (text.substr(word, keyword.size()) == keyword) return word;
    line = text.find('\n', line);
    if (line == std::string_view::npos) break;
    ++line;
  }
  return text.size();
}

Assimp::IOStream* stream_of(std::string_view bytes) {
  return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                    bytes.size());
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
  const bool writes = std::strpbrk(mode, "wa+") != nullptr;
  if (writes || !Exists(file) || !fs::is_regular_file(file, error)) return nullptr;
  const bool is_main = whole(file) == whole(main_);
  const bool is_gltf = !main_bytes_.empty();
  if (is_main && is_gltf) return stream_of(main_bytes_);
  if (is_main || is_gltf) return DefaultIOSystem::Open(file, mode);
  // What else an OBJ opens is a library of materials.
  std::ifstream stream(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), {});
  text.erase(0, first_material(text));
  libraries_.push_back(std::move(text));
  return stream_of(libraries_.back());
}

}  // namespace pah
