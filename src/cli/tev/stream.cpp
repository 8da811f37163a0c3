#include "cli/tev/stream.hpp"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "cli/tev/connection.hpp"
#include "cli/tev/packets.hpp"

namespace pah::cli {

TevStream::TevStream(TevAddress address, std::string name, const FilmSettings& film,
                     const TevLimits& limits)
    : address_(std::move(address)),
      name_(std::move(name)),
      width_(film.width),
      height_(film.height),
      limits_(limits),
      thread_([this] { run(); }) {}

TevStream::~TevStream() {
  give_up_ = Clock::now();
  queue_.abandon();
}

void TevStream::show(const Film& film, const PixelRect& rect) {
  if (!failed_) queue_.push({rect.x0, rect.y0, radiance_of(film, rect)});
}

void TevStream::finish() {
  give_up_ = Clock::now() + limits_.finishing;
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

std::optional<std::string> TevStream::take_fault() {
  const std::lock_guard lock(mutex_);
  return std::exchange(fault_, std::nullopt);
}

void TevStream::run() {
  std::optional<TevConnection> connection;
  try {
    const Clock::time_point until = Clock::now() + limits_.connecting;
    connection.emplace(address_, [&] { return Clock::now() >= until || out_of_time(); });
  } catch (const std::exception& error) {
    return fail(fmt::format("no tev listens on {}: {}", to_string(address_), error.what()));
  }
  try {
    if (!send_all(*connection))
      fail(fmt::format("tev on {} is too slow: it did not receive the whole picture",
                       to_string(address_)));
  } catch (const std::exception& error) {
    fail(fmt::format("lost tev on {}: {}", to_string(address_), error.what()));
  }
}

bool TevStream::send_all(TevConnection& connection) {
  const auto late = [this] { return out_of_time(); };
  if (!connection.send(create_image_packet(name_, width_, height_), late)) return false;
  while (const std::optional<ShownTile> tile = queue_.pop())
    if (!connection.send(update_image_packet(name_, tile->x, tile->y, tile->pixels), late))
      return false;
  connection.finish(late);
  return true;
}

void TevStream::fail(std::string fault) {
  failed_ = true;
  queue_.abandon();
  const std::lock_guard lock(mutex_);
  fault_ = std::move(fault);
}

}  // namespace pah::cli
