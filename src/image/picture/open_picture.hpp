// Reads picture files from untrusted sources: the result is an error or a picture of bounded size.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

namespace pah {

// An error in a picture file. what() does not name the file.
class PictureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr std::uint64_t most_picture_bytes = 4ULL << 30;

// A picture that is open for reading, and the proxy that it is read from, if any.
struct OpenPicture {
  std::unique_ptr<OIIO::Filesystem::IOProxy> proxy;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  // If set, do not read a row before the last one read, but open the picture again: the reader
  // would reopen the file by its name, with its metadata.
  bool forward_only = false;
};

// Opens a picture with the reader that its first bytes select, regardless of the extension.
// Rejects, before decoding, pictures of more than `max_bytes` as RGB floats. `bytes`, if given, are
// the picture, and `file` is only its name. OpenImageIO gets `config`. Throws PictureError.
[[nodiscard]] OpenPicture open_picture(const std::filesystem::path& file, std::uint64_t max_bytes,
                                       const OIIO::ImageSpec& config = {},
                                       const std::string* bytes = nullptr);

// Returns the size of a picture, or of one of its levels, as floats in three channels or more.
[[nodiscard]] double decoded_bytes(const OIIO::ImageSpec& spec);

// Detects a file that ends early by reading the row that it stores last. Throws PictureError.
void check_complete(const OpenPicture& picture);

// Decodes the whole picture and calls visit() for a few rows at a time. Throws PictureError.
void read_rows(const OpenPicture& picture,
               const std::function<void(std::span<float> values)>& visit);

// Decodes the whole picture and returns the number of unusable values. Throws PictureError.
[[nodiscard]] std::uint64_t count_unusable(const OpenPicture& picture);

// Replaces by 0 all values that are NaN, infinite, or so large that products overflow. Returns
// their number.
std::uint64_t clear_unusable(std::span<float> values);

// Returns the first line of the reader's error message, or "it is damaged" if it is empty.
[[nodiscard]] std::string reason_of(const OIIO::ImageInput& input);

}  // namespace pah
