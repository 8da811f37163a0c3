// Listens as the image viewer tev does, and takes every message at its word.
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

// What a viewer shows.
struct ListenedPicture {
  Image image;
  std::vector<bool> told;  // of each pixel
  int updates = 0;
};

// What came of one packet after the other.
class TevPictures {
 public:
  // Throws std::runtime_error, which says what is wrong, for a packet that makes no sense, or none
  // in what came before. `packet` is as long as its first bytes say.
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
  nothing,       // lets connect, and reads nothing, with little room for what is sent
};

// On a free port of the loopback address. Connections are listened to one after the other.
class TevListener {
 public:
  explicit TevListener(Listening listening = Listening::all);
  ~TevListener();
  TevListener(const TevListener&) = delete;
  TevListener& operator=(const TevListener&) = delete;

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] std::string address() const;

  // Of all connections so far.
  [[nodiscard]] TevPictures pictures() const;
  [[nodiscard]] int connections() const;
  // What was wrong with what came; empty if nothing was.
  [[nodiscard]] std::string fault() const;

 private:
  void run();
  void serve(int connection);
  // Takes whole packets off the bytes; false if this is enough.
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

// A port that nothing listens on.
[[nodiscard]] int free_port();

}  // namespace pah::test
