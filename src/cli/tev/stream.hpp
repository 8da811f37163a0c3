// The picture under way, tile by tile, to the image viewer tev.
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
  std::chrono::milliseconds finishing{2000};  // sending what waits, once the picture is finished
};

// A render never waits for the viewer: a thread connects and sends, and what that has not come to
// yet is replaced when it changes. If there is no viewer, or not any more, nothing is sent.
class TevStream {
 public:
  // The picture's name in the viewer, where it replaces one of this name. It has all pixels, also
  // those that a crop leaves out.
  TevStream(TevAddress address, std::string name, const FilmSettings& film,
            const TevLimits& limits = {});
  // Does not wait for what is not sent yet; what was sent stays in the viewer.
  ~TevStream();
  TevStream(const TevStream&) = delete;
  TevStream& operator=(const TevStream&) = delete;

  // The means of the rectangle's pixels so far, as of a tile. By several threads at a time.
  void show(const Film& film, const PixelRect& rect);

  // Nothing more is to be shown: sends what waits.
  void finish();

  // Why the viewer does not show all of the picture; told once.
  [[nodiscard]] std::optional<std::string> take_fault();

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  // False if not in time.
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
  std::jthread thread_;  // last: it uses the others
};

}  // namespace pah::cli
