#pragma once

#include <filesystem>
#include <string>

namespace pah {

// Of "a/Picture.PNG", ".png"; empty without one. Formats are told by it, whatever its case.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);

}  // namespace pah
