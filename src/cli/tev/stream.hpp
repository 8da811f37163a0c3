// Sends a running render to the image viewer tev, tile by tile.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <pah/render/film.hpp>
#include <string>
#include <thread>

#include "cli/tev/address.hpp"
#include "cli/tev/tile_queue.hpp"

namespace pah::cli {

class TevConnection;

struct TevLimits {
  std::chrono::milliseconds connecting{5000};
  std::chrono::milliseconds finishing{2000};  // for sending the remaining tiles at the end
};

// A thread connects and sends, so a render never waits for the viewer. A tile that still waits is
// replaced when it changes. Without a viewer nothing is sent.
class TevStream {
 public:
  // `name` is the picture's name in the viewer, where it replaces a picture of that name. The
  // picture has its full size, also with a crop.
  TevStream(TevAddress address, std::string name, const FilmSettings& film,
            const TevLimits& limits = {});
  // Drops tiles that are not sent yet; those that were sent stay in the viewer.
  ~TevStream();
  TevStream(const TevStream&) = delete;
  TevStream& operator=(const TevStream&) = delete;

  // Queues the current means of the tile's pixels. Thread-safe.
  void show(const Film& film, const PixelRect& rect);

  // Sends the remaining tiles; the last call.
  void finish();

  // Returns, once, why the viewer does not show the whole picture.
  [[nodiscard]] std::optional<std::string> take_fault();

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  // Returns false on a timeout.
  [[nodiscard]] bool send_all(TevConnection& connection);
  [[nodiscard]] bool out_of_time() const { return Clock::now() >= give_up_.load(); }
  void fail(std::string fault);

  TevAddress address_;
  std::string name_;
  int width_, height_;
  TevLimits limits_;
  TileQueue queue_;
  std::atomic<bool> failed_ = false;
  std::atomic<Clock::time_point> give_up_ = Clock::time_point::max();
  std::mutex mutex_;
  std::optional<std::string> fault_;
  std::jthread thread_;  // last, because it uses the other members
};

}  // namespace pah::cli
