// The picture formats that are read, told apart by their first bytes.
#pragma once

#include <string>
#include <string_view>

namespace pah {

struct PictureFormat {
  const char* name;    // as people know it
  const char* reader;  // OpenImageIO's name of it
};

// As many bytes are needed to tell.
inline constexpr std::size_t picture_head_bytes = 32;

// Null if the bytes begin none of the formats.
[[nodiscard]] const PictureFormat* find_picture_format(std::string_view head);

// "PNG, JPEG, ...".
[[nodiscard]] std::string picture_format_names();

}  // namespace pah
