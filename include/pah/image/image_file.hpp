// Pictures to and from files, by OpenImageIO: written as PNG (8- or 16-bit sRGB), JPEG (8-bit
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

// Metadata by name. Formats keep what they have room for.
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

// The first layer is the picture; the others go to formats that hold them (EXR) only. Written
// beside `file` under another name and renamed when complete. The same picture gives the same
// bytes. Throws FileError, and std::invalid_argument unless all layers are of one size and png_bits
// is 8 or 16.
void write_image(const std::filesystem::path& file, const std::vector<ImageLayer>& layers,
                 const WriteOptions& options = {});

// The texts among a picture's metadata, in no certain order. Throws FileError.
[[nodiscard]] ImageMetadata read_metadata(const std::filesystem::path& file);

// R, G and B (or the first three channels, or the first, thrice), linear: 8- and 16-bit colors are
// taken for sRGB. Throws FileError, also if the picture is larger than `max_bytes` as RGB floats.
[[nodiscard]] Image read_image(const std::filesystem::path& file,
                               std::uint64_t max_bytes = 4ULL << 30);

}  // namespace pah
