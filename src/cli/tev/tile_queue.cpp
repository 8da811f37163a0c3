#include "cli/tev/tile_queue.hpp"

namespace pah::cli {

void TileQueue::push(ShownTile tile) {
  const Place place{tile.x, tile.y};
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    const auto [waiting, is_new] = waiting_.try_emplace(place);
    // A swap, so that the older pixels are freed after the lock is released.
    std::swap(waiting->second, tile.pixels);
    if (!is_new) return;
    order_.push_back(place);
  }
  changed_.notify_one();
}

std::optional<ShownTile> TileQueue::pop() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !order_.empty(); });
  if (order_.empty()) return std::nullopt;
  const Place place = order_.front();
  order_.pop_front();
  auto node = waiting_.extract(place);
  return ShownTile{place.first, place.second, std::move(node.mapped())};
}

void TileQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

void TileQueue::abandon() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    order_.clear();
    waiting_.clear();
  }
  changed_.notify_all();
}

std::size_t TileQueue::size() const {
  const std::lock_guard lock(mutex_);
  return order_.size();
}

}  // namespace pah::cli
