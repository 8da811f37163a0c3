// A picture's bytes without its metadata: no texture needs color profiles, XMP or Exif, and their
// decoders do not stand what is not well formed.
#pragma once

#include <OpenImageIO/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace pah {

// What a header claims, where a reader makes room for it before it says how much.
struct ClaimedSize {
  std::uint64_t width = 0, height = 0, channels = 0;
};

// These leave out the metadata in place. What is not well formed is left to the decoder; a file
// that ends early throws std::runtime_error.
void strip_png(std::string& bytes);
[[nodiscard]] ClaimedSize strip_jpeg(std::string& bytes);
[[nodiscard]] ClaimedSize strip_webp(std::string& bytes);

[[nodiscard]] ClaimedSize claimed_bmp_size(std::string_view head);

// A TIFF file whose tags of metadata are read as unknown ones.
[[nodiscard]] std::unique_ptr<OIIO::Filesystem::IOProxy> open_tiff_without_metadata(
    const std::filesystem::path& file);

}  // namespace pah
