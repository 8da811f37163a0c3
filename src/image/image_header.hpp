// What a picture that a scene names is like, and whether it can be read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pah {

struct ImageHeader {
  int width = 0, height = 0;
};

// Throws FileError, saying what is wrong without naming the file: also if the picture takes more
// than `max_bytes` as RGB floats.
[[nodiscard]] ImageHeader read_image_header(const std::filesystem::path& file,
                                            std::uint64_t max_bytes);

// Reads the whole picture, and keeps nothing of it; how many of its values are not finite, or as
// good as infinite, and will be taken for 0. With `bytes`, they are the picture. Throws FileError
// likewise.
[[nodiscard]] std::uint64_t check_image_file(const std::filesystem::path& file,
                                             std::uint64_t max_bytes,
                                             const std::string* bytes = nullptr);

// The values of the first channel, row by row from the top. Throws FileError likewise.
[[nodiscard]] std::vector<float> read_first_channel(const std::filesystem::path& file,
                                                    std::uint64_t max_bytes);

}  // namespace pah
