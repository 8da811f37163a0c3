// Numbers of binary files in little-endian byte order.
#pragma once

#include <cstdint>

namespace pah {

[[nodiscard]] inline std::uint32_t load_u32(const char* bytes) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i)
    value |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return value;
}

}  // namespace pah
