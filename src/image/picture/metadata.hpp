// Removes metadata from a picture's bytes. Textures need no color profiles, XMP or Exif, and their
// decoders are not robust against malformed data.
#pragma once

#include <OpenImageIO/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace pah {

// The size in a header, for readers that allocate memory for it before the size can be checked.
struct ClaimedSize {
  std::uint64_t width = 0, height = 0, channels = 0;
};

// Remove the metadata in place. Malformed data are left to the decoder. Throw std::runtime_error
// for a file that ends early.
void strip_png(std::string& bytes);
[[nodiscard]] ClaimedSize strip_jpeg(std::string& bytes);
[[nodiscard]] ClaimedSize strip_webp(std::string& bytes);

[[nodiscard]] ClaimedSize claimed_bmp_size(std::string_view head);

// Opens a TIFF file in which the tags of metadata read as unknown tags.
[[nodiscard]] std::unique_ptr<OIIO::Filesystem::IOProxy> open_tiff_without_metadata(
    const std::filesystem::path& file);

}  // namespace pah
