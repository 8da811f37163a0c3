#include "cli/tev/address.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace pah::cli {
namespace {

constexpr std::string_view digits = "0123456789";
constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

bool consists_of(std::string_view text, std::initializer_list<std::string_view> characters) {
  return !text.empty() && std::ranges::all_of(text, [&](char c) {
    return std::ranges::any_of(characters,
                               [&](auto set) { return set.find(c) != std::string_view::npos; });
  });
}

// Port 0 is refused, because nothing can listen on it.
std::optional<std::uint16_t> parse_port(std::string_view text) {
  std::uint16_t port = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc{} || next != text.data() + text.size() || port == 0) return std::nullopt;
  return port;
}

// Parses ":PORT", or an empty text.
bool parse_port_suffix(std::string_view text, TevAddress& address) {
  if (text.empty()) return true;
  const auto port = text[0] == ':' ? parse_port(text.substr(1)) : std::nullopt;
  address.port = port.value_or(0);
  return port.has_value();
}

}  // namespace

std::optional<TevAddress> parse_tev_address(std::string_view text) {
  TevAddress address;
  std::string_view suffix;
  if (text.starts_with('[')) {
    const std::size_t end = std::min(text.find(']'), text.size());
    address.host = text.substr(1, end - 1);
    // A link-local address has a zone: fe80::1%eth0.
    if (end == text.size() || !consists_of(address.host, {digits, letters, ":.%-_"}))
      return std::nullopt;
    suffix = text.substr(end + 1);
  } else if (consists_of(text, {digits})) {
    const auto port = parse_port(text);
    if (!port) return std::nullopt;
    address.port = *port;
  } else {
    const std::size_t end = std::min(text.find(':'), text.size());
    if (end > 0) address.host = text.substr(0, end);
    if (text.empty() || !consists_of(address.host, {digits, letters, ".-_"})) return std::nullopt;
    suffix = text.substr(end);
  }
  if (!parse_port_suffix(suffix, address)) return std::nullopt;
  return address;
}

std::string to_string(const TevAddress& address) {
  const bool ipv6 = address.host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", ipv6 ? "[" : "", address.host, ipv6 ? "]" : "", address.port);
}

}  // namespace pah::cli
