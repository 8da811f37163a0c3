// Listens as the image viewer tev does, and checks every packet.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <pah/image/image.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace pah::test {

// A picture as the viewer shows it.
struct ListenedPicture {
  Image image;
  std::vector<bool> updated;  // whether each pixel was updated
  int updates = 0;
};

// The pictures that a sequence of packets results in.
class TevPictures {
 public:
  // Throws std::runtime_error with the reason if the packet is malformed or does not fit the
  // packets before. `packet` must be as long as its first bytes say.
  void take(std::string_view packet);

  [[nodiscard]] const std::map<std::string, ListenedPicture>& pictures() const { return pictures_; }
  [[nodiscard]] int created() const { return created_; }

 private:
  std::map<std::string, ListenedPicture> pictures_;
  int created_ = 0;
};

enum class Listening {
  all,
  first_packet,  // then hangs up
  nothing,       // accepts connections but reads nothing, with a small receive buffer
};

// Listens on a free port of the loopback address. Serves one connection after the other.
class TevListener {
 public:
  explicit TevListener(Listening listening = Listening::all);
  ~TevListener();
  TevListener(const TevListener&) = delete;
  TevListener& operator=(const TevListener&) = delete;

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] std::string address() const;

  // Counts and pictures are of all connections so far.
  [[nodiscard]] TevPictures pictures() const;
  [[nodiscard]] int connections() const;
  // Returns what was wrong with a packet; empty if there was no error.
  [[nodiscard]] std::string fault() const;

 private:
  void run();
  void serve(int connection);
  // Removes complete packets from the front of the bytes. Returns false if no more are wanted.
  bool take_packets(std::string& bytes);

  Listening listening_;
  int socket_ = -1;
  int port_ = 0;
  mutable std::mutex mutex_;
  TevPictures pictures_;
  int connections_ = 0;
  std::string fault_;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

// Returns a port that nothing listens on.
[[nodiscard]] int free_port();

}  // namespace pah::test
