#include "image/image_format.hpp"

#include <pah/image/image_file.hpp>

#include "base/extension.hpp"
#include "base/output_file.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

struct Format {
  const char* extension;
  Encoding encoding;
};

constexpr Format formats[] = {{".png", Encoding::png},   {".jpg", Encoding::jpeg},
                              {".jpeg", Encoding::jpeg}, {".tif", Encoding::tiff},
                              {".tiff", Encoding::tiff}, {".hdr", Encoding::rgbe},
                              {".exr", Encoding::exr}};

}  // namespace

Encoding encoding_of(const fs::path& file) {
  const std::string extension = lower_extension(file);
  for (const Format& format : formats)
    if (extension == format.extension) return format.encoding;
  std::string available;
  for (const Format& format : formats)
    available += (available.empty() ? "" : ", ") + std::string(format.extension);
  fail_to_write(file, (extension.empty() ? "the name has no extension"
                                         : "unknown picture format '" + extension + "'") +
                          "; available are " + available);
}

const std::vector<std::string>& image_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> list;
    for (const Format& format : formats) list.emplace_back(format.extension);
    return list;
  }();
  return extensions;
}

void check_writable(const fs::path& file) {
  // The TIFF writer seeks, which devices and pipes do not support.
  if (encoding_of(file) == Encoding::tiff && is_device(file))
    fail_to_write(file, "a TIFF file cannot be written to a device");
  check_can_create(file);
}

}  // namespace pah
