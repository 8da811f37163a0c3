// The picture formats that are read, recognized by their first bytes.
#pragma once

#include <string>
#include <string_view>

namespace pah {

struct PictureFormat {
  const char* name;    // for messages
  const char* reader;  // OpenImageIO's name of the format
};

// The number of bytes that identify every format.
inline constexpr std::size_t picture_head_bytes = 32;

// Returns null if the bytes begin none of the formats.
[[nodiscard]] const PictureFormat* find_picture_format(std::string_view head);

// Returns "PNG, JPEG, ...".
[[nodiscard]] std::string picture_format_names();

}  // namespace pah
