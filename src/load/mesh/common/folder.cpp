#include "load/mesh/common/folder.hpp"

#include <algorithm>
#include <pah/load/mesh_file.hpp>
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

fs::path image_of(const fs::path& mesh_file, std::string name, const fs::path& folder) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path image = mesh_file.parent_path() / name;
  if (fs::path(name).is_absolute() || !lies_in(image, folder))
    throw MeshFileError("image '" + name + "' lies outside of the scene's folder");
  std::error_code error;
  if (!fs::is_regular_file(image, error)) throw MeshFileError("there is no image '" + name + "'");
  return image;
}

}  // namespace pah
