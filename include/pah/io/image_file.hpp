// Pictures to and from files, by OpenImageIO.
#pragma once

#include <filesystem>
#include <pah/io/errors.hpp>
#include <pah/render/film.hpp>
#include <string>
#include <utility>
#include <vector>

namespace pah {

// Metadata by name: text, or a number written as one.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

struct ImageLayer {
  std::string name;                   // "" for the picture; "albedo", "normal", ...
  std::vector<std::string> channels;  // {"R", "G", "B"}, {"X", "Y", "Z"} or {"Z"}
  Image image;
};

struct WriteOptions {
  double exposure = 0;      // stops; low dynamic range files only
  bool full_float = false;  // EXR: 32-bit instead of 16-bit
  ImageMetadata metadata;
};

// The extensions that write_image takes, with dots, lower case.
[[nodiscard]] const std::vector<std::string>& image_extensions();

// Throws FileError unless `file` has a known extension and can be written; leaves no trace.
void check_writable(const std::filesystem::path& file);

// The first layer is the picture; the others go to formats that hold them (EXR) only. Written
// beside `file` under another name and renamed when complete. Throws FileError.
void write_image(const std::filesystem::path& file, const std::vector<ImageLayer>& layers,
                 const WriteOptions& options = {});

// The first three channels (or the first, thrice), linear. Throws FileError.
[[nodiscard]] Image read_image(const std::filesystem::path& file);

}  // namespace pah
