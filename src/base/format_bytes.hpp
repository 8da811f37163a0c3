#pragma once

#include <cstdint>
#include <string>

namespace pah {

// "1.50 MB", for people.
[[nodiscard]] std::string format_bytes(std::uint64_t bytes);

}  // namespace pah
