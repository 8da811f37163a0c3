#pragma once

#include <cstdint>
#include <string>

namespace pah {

// Formats a number of bytes for people: "1.50 MB".
[[nodiscard]] std::string format_bytes(std::uint64_t bytes);

}  // namespace pah
