#include "tev_listener.hpp"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <limits>
#include <stdexcept>

namespace pah::test {
namespace {

constexpr int look_milliseconds = 10;

void require(bool condition, const std::string& message) {
  if (!condition) throw std::runtime_error(message);
}

// Reads the values of a packet one after the other.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t number(std::size_t size) {
    require(bytes_.size() >= size, "a packet ends early");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value |= std::uint64_t{static_cast<std::uint8_t>(bytes_[i])} << (8 * i);
    bytes_.remove_prefix(size);
    return value;
  }
  int int32() { return static_cast<std::int32_t>(static_cast<std::uint32_t>(number(4))); }
  std::int64_t int64() { return static_cast<std::int64_t>(number(8)); }
  float float32() { return std::bit_cast<float>(static_cast<std::uint32_t>(number(4))); }
  bool flag() {
    const std::uint64_t value = number(1);
    require(value <= 1, "a flag is neither 0 nor 1");
    return value == 1;
  }
  std::string text() {
    const std::size_t end = bytes_.find('\0');
    require(end != std::string_view::npos, "a string has no end");
    const std::string text(bytes_.substr(0, end));
    bytes_.remove_prefix(end + 1);
    return text;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

void read_channels(Reader& reader) {
  require(reader.int32() == 3, "not three channels");
  for (const char* channel : {"R", "G", "B"})
    require(reader.text() == channel, std::string("no channel ") + channel);
}

ListenedPicture read_create(Reader& reader) {
  const int width = reader.int32();
  const int height = reader.int32();
  require(width > 0 && height > 0, "a picture without pixels");
  read_channels(reader);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return {
      {width, height, std::vector<glm::vec3>(pixels, glm::vec3(0))}, std::vector<bool>(pixels), 0};
}

void read_update(Reader& reader, ListenedPicture& picture) {
  read_channels(reader);
  const int x0 = reader.int32();
  const int y0 = reader.int32();
  const int width = reader.int32();
  const int height = reader.int32();
  const Image& image = picture.image;
  require(x0 >= 0 && y0 >= 0 && width > 0 && height > 0 && width <= image.width - x0 &&
              height <= image.height - y0,
          "a tile is outside of its picture");
  std::array<std::int64_t, 3> offsets{};
  std::array<std::int64_t, 3> strides{};
  for (std::int64_t& offset : offsets) offset = reader.int64();
  for (std::int64_t& stride : strides) stride = reader.int64();
  const std::int64_t pixels = std::int64_t{width} * height;
  std::int64_t count = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    require(offsets[c] >= 0 && strides[c] > 0, "an offset or a stride makes no sense");
    count = std::max(count, offsets[c] + (pixels - 1) * strides[c] + 1);
  }
  require(static_cast<std::int64_t>(reader.left()) == 4 * count, "not as many values as pixels");
  std::vector<float> values;
  for (std::int64_t i = 0; i < count; ++i) values.push_back(reader.float32());
  for (std::int64_t i = 0; i < pixels; ++i) {
    const auto place = static_cast<std::size_t>((y0 + i / width) * image.width + x0 + i % width);
    const auto value = [&](std::size_t c) {
      return values[static_cast<std::size_t>(offsets[c] + i * strides[c])];
    };
    picture.image.pixels[place] = {value(0), value(1), value(2)};
    picture.updated[place] = true;
  }
  ++picture.updates;
}

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

// Returns the port.
int bind_to_free_port(int socket) {
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof(address);
  require(::bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
              ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0,
          "cannot bind");
  return ntohs(address.sin_port);
}

bool ready(int socket) {
  pollfd waiting{socket, POLLIN, 0};
  return ::poll(&waiting, 1, look_milliseconds) > 0;
}

}  // namespace

void TevPictures::take(std::string_view packet) {
  Reader reader(packet);
  require(reader.number(4) == packet.size(), "a packet's length is not what it says");
  const std::uint64_t type = reader.number(1);
  require(type == 4 || type == 6, "a packet of another type");
  const bool focus = reader.flag();
  const std::string name = reader.text();
  require(!name.empty(), "a picture without a name");
  if (type == 4) {
    require(focus, "a picture that is not shown");
    pictures_[name] = read_create(reader);
    ++created_;
  } else {
    require(!focus, "an update that takes the focus");
    const auto picture = pictures_.find(name);
    require(picture != pictures_.end(), "an update of what was not created");
    read_update(reader, picture->second);
  }
  require(reader.left() == 0, "a packet goes on after its end");
}

TevListener::TevListener(Listening listening) : listening_(listening) {
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  // Accepted connections inherit this buffer size.
  const int room = 1024;
  if (listening == Listening::nothing)
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &room, sizeof(room));
  port_ = bind_to_free_port(socket_);
  require(::listen(socket_, 8) == 0, "cannot listen");
  thread_ = std::thread([this] { run(); });
}

TevListener::~TevListener() {
  ended_ = true;
  thread_.join();
  ::close(socket_);
}

std::string TevListener::address() const { return "127.0.0.1:" + std::to_string(port_); }

TevPictures TevListener::pictures() const {
  const std::lock_guard lock(mutex_);
  return pictures_;
}

int TevListener::connections() const {
  const std::lock_guard lock(mutex_);
  return connections_;
}

std::string TevListener::fault() const {
  const std::lock_guard lock(mutex_);
  return fault_;
}

void TevListener::run() {
  while (!ended_) {
    if (!ready(socket_)) continue;
    const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection == -1) continue;
    {
      const std::lock_guard lock(mutex_);
      ++connections_;
    }
    serve(connection);
    ::close(connection);
  }
}

void TevListener::serve(int connection) {
  std::string bytes;
  std::array<char, 65536> buffer;
  while (!ended_) {
    if (listening_ == Listening::nothing) {
      std::this_thread::sleep_for(std::chrono::milliseconds(look_milliseconds));
      continue;
    }
    if (!ready(connection)) continue;
    const ssize_t count = ::recv(connection, buffer.data(), buffer.size(), 0);
    if (count > 0) bytes.append(buffer.data(), static_cast<std::size_t>(count));
    try {
      if (count > 0 && !take_packets(bytes)) return;
      if (count <= 0) return require(bytes.empty(), "the connection ends within a packet");
    } catch (const std::exception& error) {
      const std::lock_guard lock(mutex_);
      fault_ = error.what();
      return;
    }
  }
}

bool TevListener::take_packets(std::string& bytes) {
  const std::lock_guard lock(mutex_);
  std::size_t at = 0;
  bool enough = false;
  while (!enough && bytes.size() - at >= 4) {
    const std::size_t length = Reader(std::string_view(bytes).substr(at)).number(4);
    require(length >= 5, "a packet is too short for its length and type");
    if (bytes.size() - at < length) break;
    pictures_.take(std::string_view(bytes).substr(at, length));
    at += length;
    enough = listening_ == Listening::first_packet;
  }
  bytes.erase(0, at);
  return !enough;
}

int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int port = bind_to_free_port(socket);
  ::close(socket);
  return port;
}

}  // namespace pah::test
