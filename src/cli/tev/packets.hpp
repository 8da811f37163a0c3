// The packets of the image viewer tev. Its source defines the protocol
// (https://github.com/Tom94/tev: src/Ipc.cpp and include/tev/Ipc.h define the packets, src/main.cpp
// their effect). All numbers are little-endian. A packet consists of
//   - its length in bytes, including this number: u32
//   - its type: u8
//   - the fields of that type. Strings end with a 0; flags are bytes.
#pragma once

#include <pah/image/image.hpp>
#include <string>

namespace pah::cli {

// Shows a black picture with the channels R, G and B; replaces a picture of the same name.
[[nodiscard]] std::string create_image_packet(const std::string& name, int width, int height);

// Replaces the pixels from (x, y) on; all must lie in the picture of this name.
[[nodiscard]] std::string update_image_packet(const std::string& name, int x, int y,
                                              const Image& pixels);

}  // namespace pah::cli
