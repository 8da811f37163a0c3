// Small picture files as bytes, valid and damaged.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pah::test {

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

// Returns a 24-bit picture with the pixels in `bgr`, rows from the top.
inline std::string tga(unsigned width, unsigned height, std::string_view bgr) {
  std::string bytes(18, '\0');
  bytes[2] = 2;
  bytes[12] = static_cast<char>(width & 0xFFU);
  bytes[13] = static_cast<char>(width >> 8U);
  bytes[14] = static_cast<char>(height & 0xFFU);
  bytes[15] = static_cast<char>(height >> 8U);
  bytes[16] = 24;
  bytes[17] = 0x20;
  return bytes.append(bgr);
}

inline std::string png_chunk(const std::string& type, std::string_view data) {
  std::uint32_t sum = 0xFFFFFFFFU;
  for (const char c : type + std::string(data)) {
    sum ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) sum = sum >> 1U ^ ((sum & 1U) != 0 ? 0xEDB88320U : 0);
  }
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + std::string(data) +
         big_endian(~sum);
}

// Returns an 8-bit gray or RGB picture that claims the given size, with the data `idat`.
inline std::string png(std::uint32_t width, std::uint32_t height, bool color, std::string_view idat,
                       std::string_view before_idat = "") {
  const std::string header = big_endian(width) + big_endian(height) + std::string("\x08", 1) +
                             (color ? '\x02' : '\0') + std::string(3, '\0');
  return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header) + std::string(before_idat) +
         png_chunk("IDAT", idat) + png_chunk("IEND", "");
}

// One gray row of one pixel, deflated without compression.
inline const std::string one_gray_pixel("\x78\x01\x01\x02\x00\xFD\xFF\x00\x80\x00\x82\x00\x81", 13);

}  // namespace pah::test
