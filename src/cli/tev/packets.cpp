#include "cli/tev/packets.hpp"

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace pah::cli {
namespace {

// Version 3 of an update takes the channels of a pixel interleaved, as pictures are stored here.
// Version 1 takes one channel, version 2 one channel after the other.
enum class PacketType : std::uint8_t { create_image = 4, update_image_v3 = 6 };

constexpr std::array<std::string_view, 3> channels{"R", "G", "B"};

template <std::unsigned_integral Number>
void put_number(char* to, Number number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    to[i] = static_cast<char>(static_cast<std::uint8_t>(number >> (8 * i)));
}

class Packet {
 public:
  explicit Packet(PacketType type) : bytes_(sizeof(std::uint32_t), '\0') {
    bytes_ += static_cast<char>(type);
  }

  void add(bool flag) { bytes_ += flag ? '\1' : '\0'; }
  void add(std::int32_t number) { add_number(static_cast<std::uint32_t>(number)); }
  void add(std::int64_t number) { add_number(static_cast<std::uint64_t>(number)); }
  void add(std::string_view text) {
    bytes_ += text;
    bytes_ += '\0';
  }
  void add(const std::vector<glm::vec3>& pixels) {
    std::size_t at = bytes_.size();
    bytes_.resize(at + pixels.size() * channels.size() * sizeof(float));
    for (const glm::vec3& pixel : pixels) {
      for (const float value : {pixel.x, pixel.y, pixel.z}) {
        put_number(&bytes_[at], std::bit_cast<std::uint32_t>(value));
        at += sizeof(float);
      }
    }
  }

  [[nodiscard]] std::string bytes() && {
    put_number(bytes_.data(), static_cast<std::uint32_t>(bytes_.size()));
    return std::move(bytes_);
  }

 private:
  template <std::unsigned_integral Number>
  void add_number(Number number) {
    bytes_.resize(bytes_.size() + sizeof(Number));
    put_number(&bytes_[bytes_.size() - sizeof(Number)], number);
  }

  std::string bytes_;
};

void add_channels(Packet& packet) {
  packet.add(static_cast<std::int32_t>(channels.size()));
  for (const std::string_view channel : channels) packet.add(channel);
}

}  // namespace

std::string create_image_packet(const std::string& name, int width, int height) {
  Packet packet(PacketType::create_image);
  packet.add(true);  // selects the picture
  packet.add(std::string_view(name));
  packet.add(width);
  packet.add(height);
  add_channels(packet);
  return std::move(packet).bytes();
}

std::string update_image_packet(const std::string& name, int x, int y, const Image& pixels) {
  Packet packet(PacketType::update_image_v3);
  packet.add(false);  // does not select the picture: the user may look at another
  packet.add(std::string_view(name));
  add_channels(packet);
  for (const int number : {x, y, pixels.width, pixels.height}) packet.add(number);
  constexpr auto count = static_cast<std::int64_t>(channels.size());
  for (std::int64_t channel = 0; channel < count; ++channel) packet.add(channel);  // offset
  for (std::int64_t channel = 0; channel < count; ++channel) packet.add(count);    // stride
  packet.add(pixels.pixels);
  return std::move(packet).bytes();
}

}  // namespace pah::cli
