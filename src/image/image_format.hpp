// The picture formats that are written, chosen by the file's extension.
#pragma once

#include <filesystem>

namespace pah {

enum class Encoding {
  png,   // 8- or 16-bit sRGB, exposed and clamped to [0, 1]
  jpeg,  // 8-bit sRGB, exposed and clamped too
  tiff,  // linear, 32-bit floats
  rgbe,  // linear, not negative, with a shared exponent
  exr    // linear, 16- or 32-bit floats, any number of layers
};

// Throws FileError if no format has the extension.
[[nodiscard]] Encoding encoding_of(const std::filesystem::path& file);

}  // namespace pah
