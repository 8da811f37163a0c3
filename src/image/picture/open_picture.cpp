#include "image/picture/open_picture.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <new>
#include <vector>

#include "image/picture/formats.hpp"
#include "image/picture/metadata.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

std::string read_head(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw PictureError("it does not exist");
  if (!fs::is_regular_file(status)) throw PictureError("it is not a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw PictureError("it cannot be opened");
  std::string head(picture_head_bytes, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head;
}

const PictureFormat& format_of(std::string_view head) {
  if (head.empty()) throw PictureError("it is empty");
  const PictureFormat* format = find_picture_format(head);
  if (format == nullptr)
    throw PictureError("its first bytes match no supported picture format; supported are " +
                       picture_format_names());
  return *format;
}

std::string described_bytes(std::uint64_t bytes) {
  return bytes >> 20U > 0 ? std::to_string(bytes >> 20U) + " MiB"
                          : std::to_string(bytes) + " bytes";
}

std::string read_bytes(const fs::path& file, std::uint64_t max_bytes) {
  const std::uintmax_t size = fs::file_size(file);
  if (size > max_bytes) throw PictureError("it has more than " + described_bytes(max_bytes));
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

[[noreturn]] void fail_by_size(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                               std::uint64_t max_bytes) {
  throw PictureError(std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                     std::to_string(channels) + (channels == 1 ? " channel" : " channels") +
                     " are more than " + described_bytes(max_bytes) + " as RGB floats");
}

// Some readers allocate memory for the size in the header as soon as they open the file.
void check_claim(const ClaimedSize& claimed, std::uint64_t max_bytes) {
  const double bytes = static_cast<double>(claimed.width) * static_cast<double>(claimed.height) *
                       static_cast<double>(claimed.channels) * sizeof(float);
  if (bytes > static_cast<double>(max_bytes))
    fail_by_size(claimed.width, claimed.height, claimed.channels, max_bytes);
}

// Bytes that a MemoryFile owns and reads.
struct Bytes {
  std::string bytes;
};
class MemoryFile final : private Bytes, public OIIO::Filesystem::IOMemReader {
 public:
  explicit MemoryFile(std::string text)
      : Bytes{std::move(text)}, IOMemReader(bytes.data(), bytes.size()) {}
};

bool reads_from_memory(std::string_view reader) {
  return reader == "png" || reader == "jpeg" || reader == "webp";
}

// Returns the proxy that the reader reads from, or null for the file itself.
std::unique_ptr<OIIO::Filesystem::IOProxy> prepare_bytes(std::string_view reader,
                                                         const fs::path& file,
                                                         const std::string* given,
                                                         std::string_view head,
                                                         std::uint64_t max_bytes) {
  if (given != nullptr && !reads_from_memory(reader))
    throw PictureError("a picture inside another file must be PNG, JPEG or WebP");
  if (reader == "tiff") return open_tiff_without_metadata(file);
  if (reader == "bmp") check_claim(claimed_bmp_size(head), max_bytes);
  if (!reads_from_memory(reader)) return nullptr;
  std::string bytes = given != nullptr ? *given : read_bytes(file, max_bytes);
  if (reader == "png") strip_png(bytes);
  if (reader == "jpeg") check_claim(strip_jpeg(bytes), max_bytes);
  if (reader == "webp") check_claim(strip_webp(bytes), max_bytes);
  return std::make_unique<MemoryFile>(std::move(bytes));
}

OpenPicture open_unguarded(const fs::path& file, const std::string* bytes, std::uint64_t max_bytes,
                           const OIIO::ImageSpec& config) {
  const std::string head =
      bytes != nullptr ? bytes->substr(0, picture_head_bytes) : read_head(file);
  const PictureFormat& format = format_of(head);
  OpenPicture picture;
  picture.forward_only = reads_from_memory(format.reader);
  picture.proxy = prepare_bytes(format.reader, file, bytes, head, max_bytes);
  picture.input = OIIO::ImageInput::create(format.reader);
  if (picture.input == nullptr)
    throw PictureError("OpenImageIO was built without " + std::string(format.name));
  if (picture.proxy != nullptr) picture.input->set_ioproxy(picture.proxy.get());
  if (!picture.input->open(file.string(), picture.spec, config))
    throw PictureError(reason_of(*picture.input));
  const OIIO::ImageSpec& spec = picture.spec;
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1 || spec.deep)
    throw PictureError("it is not a flat picture");
  if (decoded_bytes(spec) > static_cast<double>(max_bytes))
    fail_by_size(static_cast<unsigned>(spec.width), static_cast<unsigned>(spec.height),
                 static_cast<unsigned>(spec.nchannels), max_bytes);
  return picture;
}

}  // namespace

OpenPicture open_picture(const fs::path& file, std::uint64_t max_bytes,
                         const OIIO::ImageSpec& config, const std::string* bytes) {
  try {
    return open_unguarded(file, bytes, max_bytes, config);
  } catch (const PictureError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw PictureError("there is not enough memory for it");
  } catch (const std::exception& error) {
    throw PictureError(error.what());
  }
}

// Environments are decoded to RGB, and files are read in whole tiles, which may be larger than the
// image.
double decoded_bytes(const OIIO::ImageSpec& spec) {
  const double image = static_cast<double>(spec.width) * spec.height;
  const double tile = static_cast<double>(spec.tile_width) * spec.tile_height;
  return std::max(image, tile) * std::max(spec.nchannels, 3) * sizeof(float);
}

void check_complete(const OpenPicture& picture) {
  const OIIO::ImageSpec& spec = picture.spec;
  const bool tiled = spec.tile_width > 0;
  const std::size_t texels = tiled ? spec.tile_pixels() : static_cast<std::size_t>(spec.width);
  std::vector<float> values(texels * static_cast<std::size_t>(spec.nchannels));
  const auto read = [&](int column, int row) {
    return tiled
               ? picture.input->read_tile(spec.x + column / spec.tile_width * spec.tile_width,
                                          spec.y + row / spec.tile_height * spec.tile_height,
                                          spec.z, OIIO::TypeFloat, values.data())
               : picture.input->read_scanline(spec.y + row, spec.z, OIIO::TypeFloat, values.data());
  };
  // Reads both ends, because rows may be stored from the top or from the bottom.
  if (!read(0, 0) || !read(spec.width - 1, spec.height - 1))
    throw PictureError(reason_of(*picture.input));
}

void read_rows(const OpenPicture& picture,
               const std::function<void(std::span<float> values)>& visit) {
  const OIIO::ImageSpec& spec = picture.spec;
  // A row of tiles, or the most rows in a block of an EXR file.
  const int step = spec.tile_width > 0 ? spec.tile_height : 256;
  std::vector<float> values;
  for (int row = 0; row < spec.height; row += step) {
    const int first = spec.y + row, last = spec.y + std::min(row + step, spec.height);
    values.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(last - first) *
                  static_cast<std::size_t>(spec.nchannels));
    const bool read =
        spec.tile_width > 0
            ? picture.input->read_tiles(0, 0, spec.x, spec.x + spec.width, first, last, spec.z,
                                        spec.z + 1, 0, spec.nchannels, OIIO::TypeFloat,
                                        values.data())
            : picture.input->read_scanlines(0, 0, first, last, spec.z, 0, spec.nchannels,
                                            OIIO::TypeFloat, values.data());
    if (!read) throw PictureError(reason_of(*picture.input));
    visit(values);
  }
}

std::uint64_t count_unusable(const OpenPicture& picture) {
  std::uint64_t count = 0;
  read_rows(picture, [&](std::span<float> values) { count += clear_unusable(values); });
  return count;
}

std::uint64_t clear_unusable(std::span<float> values) {
  std::uint64_t count = 0;
  for (float& value : values) {
    if (std::abs(value) <= 0x1p100F) continue;
    value = 0;
    ++count;
  }
  return count;
}

std::string reason_of(const OIIO::ImageInput& input) {
  std::string reason = input.geterror();
  reason.resize(std::min(reason.find('\n'), reason.size()));
  return reason.empty() ? "it is damaged" : reason;
}

}  // namespace pah
