#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <pah/render/render.hpp>

#include "parallel/parallel_for.hpp"
#include "render/path_tracer.hpp"

namespace pah {
namespace {

constexpr int tile_size = 32;
constexpr int most_samples_per_pass = 16;
constexpr std::size_t batch_capacity =
    static_cast<std::size_t>(tile_size) * tile_size * most_samples_per_pass;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

PixelRect pixels_of(const FilmSettings& film) {
  PixelRect rect{0, film.width, 0, film.height};
  if (film.crop) {
    rect.x0 = std::clamp(film.crop->x0, 0, film.width);
    rect.x1 = std::clamp(film.crop->x1, rect.x0, film.width);
    rect.y0 = std::clamp(film.crop->y0, 0, film.height);
    rect.y1 = std::clamp(film.crop->y1, rect.y0, film.height);
  }
  return rect;
}

std::vector<PixelRect> tiles_of(const PixelRect& rect) {
  std::vector<PixelRect> tiles;
  for (int y = rect.y0; y < rect.y1; y += tile_size) {
    for (int x = rect.x0; x < rect.x1; x += tile_size) {
      tiles.push_back({x, std::min(x + tile_size, rect.x1), y, std::min(y + tile_size, rect.y1)});
    }
  }
  return tiles;
}

void add(RenderCounts& sum, const RenderCounts& other) {
  for (std::size_t kind = 0; kind < sum.rays.size(); ++kind) {
    sum.rays[kind] += other.rays[kind];
    sum.traversal[kind].nodes += other.traversal[kind].nodes;
    sum.traversal[kind].triangles += other.traversal[kind].triangles;
  }
  sum.nan_samples += other.nan_samples;
}

// Tells the caller how far a render is, some ten times a second, from whichever thread is there.
class Reporter {
 public:
  Reporter(const RenderOptions& options, Clock::time_point start, double total_samples)
      : options_(options), start_(start), total_samples_(total_samples) {}

  void tile_done(std::uint64_t samples, std::uint64_t rays, int finished) {
    samples_ += samples;
    rays_ += rays;
    if (!options_.on_progress) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    const double now = seconds_since(start_);
    if (!lock.owns_lock() || now - last_ < 0.1) return;
    last_ = now;
    report(now, finished);
  }

  void pass_done(int finished) {
    if (options_.on_progress) report(seconds_since(start_), finished);
  }

 private:
  void report(double now, int finished) {
    options_.on_progress(
        {std::min(1.0, static_cast<double>(samples_) / total_samples_), now, rays_, finished});
  }

  const RenderOptions& options_;
  Clock::time_point start_;
  double total_samples_;
  std::atomic<std::uint64_t> samples_ = 0, rays_ = 0;
  std::mutex mutex_;
  double last_ = 0;
};

// The samples of the next pass: few at first, so that a whole picture is there soon, then as many
// as a batch holds; no more than the time left allows at the rate so far, perhaps none.
int next_pass(int finished, int samples, double elapsed, double time_limit) {
  int count = std::min({std::max(1, finished), most_samples_per_pass, samples - finished});
  if (time_limit > 0 && finished > 0) {
    const double affordable = (time_limit - elapsed) / elapsed * finished;
    count = static_cast<int>(std::clamp(affordable, 0.0, static_cast<double>(count)));
  }
  return count;
}

}  // namespace

RenderResult render(const World& world, const Accelerator& accelerator, const FilmSettings& film,
                    const RenderSettings& settings, const RenderOptions& options) {
  const Clock::time_point start = Clock::now();
  RenderResult result;
  result.film.rect = pixels_of(film);
  const auto pixels = static_cast<std::size_t>(result.film.rect.width()) *
                      static_cast<std::size_t>(result.film.rect.height());
  result.film.pixels.resize(pixels);

  const TextureStore textures(world.textures);
  const PathTracer tracer(world, accelerator, textures, film, settings, options.count_traversal);
  const std::vector<PixelRect> tiles = tiles_of(result.film.rect);
  Reporter reporter(options, start,
                    static_cast<double>(pixels) * static_cast<double>(settings.samples));
  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };

  // More threads than processors are granted if asked for.
  std::optional<tbb::global_control> allowance;
  if (options.threads > tbb::this_task_arena::max_concurrency()) {
    allowance.emplace(tbb::global_control::max_allowed_parallelism,
                      static_cast<std::size_t>(options.threads));
  }
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  tbb::enumerable_thread_specific<PathBatch> batches(
      [&] { return tracer.make_batch(batch_capacity); });
  while (result.samples < settings.samples && !stopped()) {
    const int count =
        next_pass(result.samples, settings.samples, seconds_since(start), options.time_limit);
    if (count == 0) break;
    const auto trace_tile = [&](std::size_t i) {
      if (stopped()) return;
      PathBatch& batch = batches.local();
      const auto rays_before = batch.counts.rays;
      tracer.trace(tiles[i], result.samples, count, batch, result.film);
      std::uint64_t rays = 0;
      for (std::size_t kind = 0; kind < rays_before.size(); ++kind) {
        rays += batch.counts.rays[kind] - rays_before[kind];
      }
      const auto samples = static_cast<std::uint64_t>(tiles[i].width()) *
                           static_cast<std::uint64_t>(tiles[i].height()) *
                           static_cast<std::uint64_t>(count);
      reporter.tile_done(samples, rays, result.samples);
    };
    arena.execute([&] { parallel_for(tiles.size(), 1, trace_tile); });
    if (stopped()) break;
    result.samples += count;
    reporter.pass_done(result.samples);
  }
  for (const PathBatch& batch : batches) add(result.counts, batch.counts);
  result.complete = result.samples == settings.samples;
  result.seconds = seconds_since(start);
  return result;
}

}  // namespace pah
