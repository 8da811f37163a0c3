// The address of the image viewer tev (--tev).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pah::cli {

// The defaults are tev's own.
struct TevAddress {
  std::string host = "127.0.0.1";  // a name or an address, IPv6 without brackets
  std::uint16_t port = 14158;

  [[nodiscard]] bool operator==(const TevAddress&) const = default;
};

// Parses HOST, HOST:PORT, :PORT or PORT; IPv6 addresses are in brackets. Returns nothing for other
// texts.
[[nodiscard]] std::optional<TevAddress> parse_tev_address(std::string_view text);

// Returns the full form, with host and port.
[[nodiscard]] std::string to_string(const TevAddress& address);

}  // namespace pah::cli
