#pragma once

#include <filesystem>
#include <string>

namespace pah {

// Returns ".png" for "a/Picture.PNG"; empty if the name has no extension.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);

}  // namespace pah
