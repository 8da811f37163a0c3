// Where an image viewer listens: --tev.
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

// HOST, HOST:PORT, :PORT or PORT; IPv6 addresses are in brackets. None if it is nothing of these.
[[nodiscard]] std::optional<TevAddress> parse_tev_address(std::string_view text);

// As it is written in full.
[[nodiscard]] std::string to_string(const TevAddress& address);

}  // namespace pah::cli
