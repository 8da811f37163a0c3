// Reads and writes pictures with OpenImageIO. Written formats: PNG (8- or 16-bit sRGB), JPEG (8-bit
// sRGB), HDR (RGBE), TIFF and EXR (linear floats).
#pragma once

#include <cstdint>
#include <filesystem>
#include <pah/base/errors.hpp>
#include <pah/image/image.hpp>
#include <string>
#include <utility>
#include <vector>

namespace pah {

// Metadata by name. Each format keeps the entries that it supports.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

struct ImageLayer {
  std::string name;                   // "" for the picture; "albedo", "normal", ...
  std::vector<std::string> channels;  // {"R", "G", "B"}, {"X", "Y", "Z"} or {"Z"}
  Image image;
};

struct WriteOptions {
  double exposure = 0;      // stops; PNG and JPEG only
  int png_bits = 8;         // or 16
  bool full_float = false;  // EXR: 32-bit colors; depth and variance always are
  ImageMetadata metadata;
};

// The extensions that write_image takes, with dots, lower case.
[[nodiscard]] const std::vector<std::string>& image_extensions();

// Throws FileError unless `file` has a known extension and can be written; leaves no trace.
void check_writable(const std::filesystem::path& file);

// Writes the layers. The first is the picture; only EXR files hold the others. The file is written
// under another name beside `file` and renamed when it is complete. The same picture gives the same
// bytes. Throws FileError, and std::invalid_argument unless all layers are of one size and png_bits
// is 8 or 16.
void write_image(const std::filesystem::path& file, const std::vector<ImageLayer>& layers,
                 const WriteOptions& options = {});

// Reads the text entries of a picture's metadata, in no particular order. Throws FileError.
[[nodiscard]] ImageMetadata read_metadata(const std::filesystem::path& file);

// Reads R, G and B as linear values; without these names the first three channels, or the first
// channel three times. Integer colors are taken to be sRGB. Throws FileError, also if the picture
// takes more than `max_bytes` as RGB floats.
[[nodiscard]] Image read_image(const std::filesystem::path& file,
                               std::uint64_t max_bytes = 4ULL << 30);

}  // namespace pah
