// Sizes and checks of the pictures that a scene names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pah {

struct ImageHeader {
  int width = 0, height = 0;
};

// Throws FileError, also if the picture takes more than `max_bytes` as RGB floats. The message does
// not name the file.
[[nodiscard]] ImageHeader read_image_header(const std::filesystem::path& file,
                                            std::uint64_t max_bytes);

// Reads the whole picture without keeping it. Returns the number of values that are not finite, or
// too large, and will be replaced by 0. `bytes`, if given, are the file's content. Throws FileError
// like read_image_header().
[[nodiscard]] std::uint64_t check_image_file(const std::filesystem::path& file,
                                             std::uint64_t max_bytes,
                                             const std::string* bytes = nullptr);

// Returns the values of the first channel, row by row from the top. Throws FileError like
// read_image_header().
[[nodiscard]] std::vector<float> read_first_channel(const std::filesystem::path& file,
                                                    std::uint64_t max_bytes);

}  // namespace pah
