#include "image/picture/formats.hpp"

#include <array>

namespace pah {
namespace {

using namespace std::string_view_literals;

// TGA has no magic number, so the header must make sense.
bool is_tga(std::string_view head) {
  if (head.size() < 18) return false;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(head[i]); };
  const bool has_palette = byte(1) == 1;
  const unsigned kind = byte(2) & ~8U;  // 8: run-length encoding
  const unsigned bits = byte(16);
  const bool known_kind = kind == 1 ? has_palette : kind == 2 || kind == 3;
  const bool known_bits = bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32;
  return byte(1) <= 1 && known_kind && byte(2) < 12 && known_bits;
}

struct Recognized {
  PictureFormat format;
  bool (*begins)(std::string_view head);
};

constexpr auto recognized = std::to_array<Recognized>({
    {{"PNG", "png"}, [](std::string_view head) { return head.starts_with("\x89PNG\r\n\x1A\n"); }},
    {{"JPEG", "jpeg"}, [](std::string_view head) { return head.starts_with("\xFF\xD8\xFF"); }},
    {{"EXR", "openexr"},
     [](std::string_view head) { return head.starts_with("\x76\x2F\x31\x01"); }},
    {{"Radiance HDR", "hdr"},
     [](std::string_view head) {
       return head.starts_with("#?RADIANCE") || head.starts_with("#?RGBE");
     }},
    {{"TIFF", "tiff"},
     [](std::string_view head) {
       return head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv) ||
              head.starts_with("II+\0"sv) || head.starts_with("MM\0+"sv);
     }},
    {{"BMP", "bmp"}, [](std::string_view head) { return head.starts_with("BM"); }},
    {{"WebP", "webp"},
     [](std::string_view head) {
       return head.starts_with("RIFF") && head.size() >= 12 && head.substr(8, 4) == "WEBP";
     }},
    {{"TGA", "targa"}, is_tga},
});

}  // namespace

const PictureFormat* find_picture_format(std::string_view head) {
  for (const Recognized& candidate : recognized)
    if (candidate.begins(head)) return &candidate.format;
  return nullptr;
}

std::string picture_format_names() {
  std::string names;
  for (const Recognized& known : recognized)
    names += (names.empty() ? "" : ", ") + std::string(known.format.name);
  return names;
}

}  // namespace pah
