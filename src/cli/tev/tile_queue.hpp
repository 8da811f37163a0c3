// A queue of finished tiles for a slower reader.
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <pah/image/image.hpp>
#include <utility>

namespace pah::cli {

struct ShownTile {
  int x = 0, y = 0;  // of its first pixel, in the picture
  Image pixels;
};

// A first-in, first-out queue in which a newer state of a waiting tile replaces the older one. So
// it never holds more tiles than the picture has. Thread-safe.
class TileQueue {
 public:
  // Adds a tile; its first pixel identifies it. A closed queue ignores it.
  void push(ShownTile tile);
  // Waits for a tile. Returns nothing once the queue is closed and empty.
  [[nodiscard]] std::optional<ShownTile> pop();
  void close();
  // Closes the queue and drops the waiting tiles.
  void abandon();

  [[nodiscard]] std::size_t size() const;

 private:
  using Place = std::pair<int, int>;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Place> order_;
  std::map<Place, Image> waiting_;  // the pixels of each tile in `order_`
  bool closed_ = false;
};

}  // namespace pah::cli
