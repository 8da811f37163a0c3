#include "image/picture/metadata.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace pah {
namespace {

// Returns the number in bytes [at, at + count), which must exist.
std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t count, bool big) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value = value << 8U | static_cast<unsigned char>(bytes[at + (big ? i : count - 1 - i)]);
  return value;
}

// Keeps ranges of a string, and moves them to its front in order.
class Compaction {
 public:
  explicit Compaction(std::string& bytes) : bytes_(bytes) {}
  void keep(std::size_t from, std::size_t to) {
    std::copy(bytes_.data() + from, bytes_.data() + to, bytes_.data() + end_);
    end_ += to - from;
  }
  void finish() { bytes_.resize(end_); }

 private:
  std::string& bytes_;
  std::size_t end_ = 0;
};

[[noreturn]] void fail_at_end() { throw std::runtime_error("the file ends early"); }

}  // namespace

void strip_png(std::string& bytes) {
  constexpr std::size_t magic = 8, around = 12;  // length, type and checksum of a chunk
  Compaction kept(bytes);
  kept.keep(0, magic);
  for (std::size_t at = magic;;) {
    if (bytes.size() - at < around) fail_at_end();
    const std::uint64_t size = around + number_at(bytes, at, 4, true);
    if (size > bytes.size() - at) fail_at_end();
    const std::string type = bytes.substr(at + 4, 4);
    const bool critical = type[0] >= 'A' && type[0] <= 'Z';
    if (critical || type == "tRNS") kept.keep(at, at + size);
    at += size;
    if (type == "IEND") break;
  }
  kept.finish();
}

ClaimedSize strip_jpeg(std::string& bytes) {
  constexpr unsigned app_0 = 0xE0, app_14 = 0xEE, app_15 = 0xEF, comment = 0xFE, scan = 0xDA;
  ClaimedSize claimed;
  Compaction kept(bytes);
  std::size_t at = 2;
  kept.keep(0, at);
  for (;;) {
    if (bytes.size() - at < 4) fail_at_end();
    const unsigned marker = static_cast<unsigned char>(bytes[at + 1]);
    // Leaves the scan, and anything that is not a segment, to the decoder.
    if (bytes[at] != '\xFF' || marker == scan || marker == 0xFF) break;
    const std::uint64_t size = 2 + number_at(bytes, at + 2, 2, true);
    if (size > bytes.size() - at) fail_at_end();
    const bool frame =
        (marker & 0xF0U) == 0xC0 && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame && size >= 10)
      claimed = {number_at(bytes, at + 7, 2, true), number_at(bytes, at + 5, 2, true),
                 number_at(bytes, at + 9, 1, true)};
    // APP0 names the format, APP14 (Adobe) the color model.
    const bool metadata = (marker >= app_0 && marker <= app_15) || marker == comment;
    if (!metadata || marker == app_0 || marker == app_14) kept.keep(at, at + size);
    at += size;
  }
  // Within a scan, these bytes always end the picture.
  if (bytes.find("\xFF\xD9", at) == std::string::npos) fail_at_end();
  kept.keep(at, bytes.size());
  kept.finish();
  return claimed;
}

ClaimedSize strip_webp(std::string& bytes) {
  constexpr std::size_t flags = 20;
  if (bytes.size() < 30 || number_at(bytes, 4, 4, false) + 8 > bytes.size()) fail_at_end();
  if (bytes.compare(12, 4, "VP8X") != 0) return {};  // at most 16384 x 16384
  constexpr unsigned alpha_and_animation = 0x12;
  bytes[flags] = static_cast<char>(static_cast<unsigned char>(bytes[flags]) & alpha_and_animation);
  return {1 + number_at(bytes, 24, 3, false), 1 + number_at(bytes, 27, 3, false), 3};
}

ClaimedSize claimed_bmp_size(std::string_view head) {
  if (head.size() < 26) fail_at_end();
  // The oldest header has 12 bytes and 16-bit sizes. A negative height means rows from the top.
  if (number_at(head, 14, 4, false) == 12)
    return {number_at(head, 18, 2, false), number_at(head, 20, 2, false), 1};
  const auto size = [&](std::size_t at) {
    const auto value = static_cast<std::int32_t>(number_at(head, at, 4, false));
    return static_cast<std::uint64_t>(value < 0 ? -static_cast<std::int64_t>(value) : value);
  };
  return {size(18), size(22), 1};
}

}  // namespace pah
