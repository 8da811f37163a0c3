#include <algorithm>
#include <atomic>
#include <iterator>
#include <mutex>
#include <numeric>
#include <pah/render/render.hpp>
#include <pah/render/session.hpp>
#include <span>
#include <utility>
#include <vector>

#include "base/stopwatch.hpp"

namespace pah {
namespace {

// Reports progress to the caller about ten times a second, from any thread.
class Reporter {
 public:
  Reporter(const RenderOptions& options, const Stopwatch& elapsed, double total_samples)
      : options_(options), elapsed_(elapsed), total_samples_(total_samples) {}

  void tile_done(std::uint64_t samples, std::uint64_t rays, int finished) {
    samples_ += samples;
    rays_ += rays;
    if (!options_.on_progress) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    const double now = elapsed_.seconds();
    if (!lock.owns_lock() || now - last_ < 0.1) return;
    last_ = now;
    report(now, finished);
  }

  void pass_done(int finished) {
    if (options_.on_progress) report(elapsed_.seconds(), finished);
  }

  void between_passes(const Film& film, const FilmSamples& held) const {
    if (options_.on_pass)
      options_.on_pass(film, held, progress(elapsed_.seconds(), held.to - held.from));
  }

 private:
  [[nodiscard]] Progress progress(double now, int finished) const {
    return {std::min(1.0, static_cast<double>(samples_) / total_samples_), now, rays_, finished};
  }
  void report(double now, int finished) { options_.on_progress(progress(now, finished)); }

  const RenderOptions& options_;
  const Stopwatch& elapsed_;
  double total_samples_;
  std::atomic<std::uint64_t> samples_ = 0, rays_ = 0;
  std::mutex mutex_;
  double last_ = 0;
};

// The seconds of a render so far: in total, and in its passes alone.
struct Spent {
  double total = 0, passes = 0;
};

// Returns the samples of the next pass: few at first, so that a complete picture exists soon, then
// as many as a batch holds. The rate so far limits them to the longest pass allowed and to the
// remaining time; the result may be 0.
int next_pass(int finished, int samples, const Spent& spent, const RenderOptions& options) {
  int count = std::min({std::max(1, finished), RenderSession::batch_samples, samples - finished});
  if (finished == 0) return count;
  const auto limit_to = [&](double seconds, int least) {
    const double affordable = seconds / spent.passes * finished;
    count = static_cast<int>(
        std::clamp(affordable, static_cast<double>(least), static_cast<double>(count)));
  };
  if (options.pass_seconds > 0) limit_to(options.pass_seconds, 1);
  if (options.time_limit > 0) limit_to(options.time_limit - spent.total, 0);
  return count;
}

// Records the tiles that a stopped pass did not finish.
void leave_behind(std::span<const std::size_t> tiles, std::span<const std::size_t> finished,
                  int count, FilmSamples& held) {
  std::vector<std::size_t> behind;
  std::ranges::set_difference(tiles, finished, std::back_inserter(behind));
  held.behind = std::move(behind);
  held.ahead = count;
}

}  // namespace

RenderResult render(const World& world, const Accelerator& accelerator, const FilmSettings& film,
                    const RenderSettings& settings, const RenderOptions& options,
                    StartedFilm started) {
  const Stopwatch elapsed;
  RenderSession session(world, accelerator, film, settings,
                        {options.threads, options.count_traversal});
  const std::span<const PixelRect> tiles = session.tiles();
  const auto show = [&](const PixelRect& tile) {
    if (options.on_tile) options.on_tile(session.film(), tile);
  };
  if (!started.film.pixels.empty()) {
    session.restore(std::move(started.film));
    std::ranges::for_each(tiles, show);
  }
  std::vector<std::size_t> all(tiles.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const int first = started.samples.to;
  Reporter reporter(options, elapsed,
                    static_cast<double>(session.film().pixels.size()) *
                        static_cast<double>(settings.samples - first));
  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };

  RenderResult result;
  result.held = std::move(started.samples);
  FilmSamples& held = result.held;
  result.samples = held.to - held.from;
  // Time is never up before every pixel has a sample, because a picture with holes is useless.
  const auto out_of_time = [&] {
    return options.time_limit > 0 && result.samples > 0 && elapsed.seconds() >= options.time_limit;
  };
  std::atomic<bool> stop_pass = false;
  double in_passes = 0;  // seconds
  while (held.to < settings.samples && !stopped()) {
    const bool goes_on = !held.behind.empty();
    const std::span<const std::size_t> todo = goes_on ? held.behind : all;
    const int count = goes_on ? held.ahead
                              : next_pass(held.to - first, settings.samples - first,
                                          {elapsed.seconds(), in_passes}, options);
    if (count == 0) break;
    const Stopwatch pass;
    const auto tile_done = [&](const FinishedTile& tile) {
      const PixelRect& rect = tiles[tile.index];
      show(rect);
      const auto samples = static_cast<std::uint64_t>(rect.width()) *
                           static_cast<std::uint64_t>(rect.height()) *
                           static_cast<std::uint64_t>(count);
      reporter.tile_done(samples, tile.rays, result.samples);
      if (stopped() || out_of_time()) stop_pass = true;
    };
    const auto finished = session.render_pass(todo, held.to, count, {&stop_pass, tile_done});
    if (finished.size() < todo.size()) {
      if (!finished.empty()) leave_behind(todo, finished, count, held);
      break;
    }
    in_passes += pass.seconds();
    held = {held.from, held.to + count, 0, {}};
    result.samples += count;
    reporter.pass_done(result.samples);
    reporter.between_passes(session.film(), held);
  }
  result.counts = session.counts();
  result.film = std::move(session).take_film();
  result.complete = held.to == settings.samples;
  result.seconds = elapsed.seconds();
  return result;
}

}  // namespace pah
