// Finished tiles on their way to somebody slower.
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

// First in, first out, but a tile that still waits is replaced by its newer state: so there are
// never more waiting than the picture has, and none waits for another twice. All of it may be
// called by any thread.
class TileQueue {
 public:
  // Tiles are told from one another by their first pixels. Once closed, they are left out.
  void push(ShownTile tile);
  // Waits for one. None once the queue is closed, and what was in it taken.
  [[nodiscard]] std::optional<ShownTile> pop();
  void close();
  // Also drops what waits.
  void abandon();

  [[nodiscard]] std::size_t size() const;

 private:
  using Place = std::pair<int, int>;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Place> order_;
  std::map<Place, Image> waiting_;  // of each place in `order_`
  bool closed_ = false;
};

}  // namespace pah::cli
