// The picture formats that are written, told apart by the file's extension.
#pragma once

#include <filesystem>
#include <string>

namespace pah {

enum class Encoding {
  png,   // 8- or 16-bit sRGB, exposed and clamped to [0, 1]
  jpeg,  // 8-bit sRGB, likewise
  tiff,  // linear, 32-bit floats
  rgbe,  // linear, not negative, a shared exponent
  exr    // linear, 16- or 32-bit floats, any number of layers
};

// Throws FileError if the extension is of none.
[[nodiscard]] Encoding encoding_of(const std::filesystem::path& file);

[[noreturn]] void fail_to_write(const std::filesystem::path& file, const std::string& why);

}  // namespace pah
