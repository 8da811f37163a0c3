// What a picture that a scene names is like, read without decoding it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace pah {

struct ImageHeader {
  int width = 0, height = 0, depth = 0, channels = 0;
  std::uint64_t pixels = 0;
  std::uint64_t bytes = 0;  // when decoded as they are stored
};

// Throws FileError, with the reader's own words or none.
[[nodiscard]] ImageHeader read_image_header(const std::filesystem::path& file);

// The values of the first channel, row by row from the top. Throws FileError likewise.
[[nodiscard]] std::vector<float> read_first_channel(const std::filesystem::path& file);

}  // namespace pah
