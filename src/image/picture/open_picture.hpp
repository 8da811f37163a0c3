// Picture files from anywhere: whatever their bytes, an error or a picture of bounded size.
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

// What is wrong with a picture file; what() does not name it.
class PictureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr std::uint64_t most_picture_bytes = 4ULL << 30;

// A picture open to be read, and what it is read from, if not the file itself.
struct OpenPicture {
  std::unique_ptr<OIIO::Filesystem::IOProxy> proxy;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  // To read a row before the last one read, the reader would open the file again, by its name and
  // with all that was left out: open the picture anew instead.
  bool forward_only = false;
};

// Opens with the reader that the first bytes name, whatever the extension says, and refuses what
// takes more than `max_bytes` as RGB floats before it is decoded. With `bytes`, they are the
// picture and `file` is its name. `config` is OpenImageIO's. Throws PictureError.
[[nodiscard]] OpenPicture open_picture(const std::filesystem::path& file, std::uint64_t max_bytes,
                                       const OIIO::ImageSpec& config = {},
                                       const std::string* bytes = nullptr);

// Of a picture or a level of it, as floats of three channels or more.
[[nodiscard]] double decoded_bytes(const OIIO::ImageSpec& spec);

// A file that ends early shows in the row that it stores last. Throws PictureError.
void check_complete(const OpenPicture& picture);

// Decodes everything, calling visit() with some rows at a time. Throws PictureError.
void read_rows(const OpenPicture& picture,
               const std::function<void(std::span<float> values)>& visit);

// Decodes everything; how many values are unusable. Throws PictureError.
[[nodiscard]] std::uint64_t count_unusable(const OpenPicture& picture);

// Sets to 0 what is no number, infinite, or so large that products of it soon are; how many.
std::uint64_t clear_unusable(std::span<float> values);

// The first line of the reader's own words, or "it is damaged" if it has none.
[[nodiscard]] std::string reason_of(const OIIO::ImageInput& input);

}  // namespace pah
