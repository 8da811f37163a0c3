#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <pah/render/session.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/parallel_for.hpp"
#include "render/path/path_tracer.hpp"

namespace pah {
namespace {

constexpr int tile_size = 32;
constexpr std::size_t batch_capacity =
    static_cast<std::size_t>(tile_size) * tile_size * RenderSession::batch_samples;

std::vector<PixelRect> tiles_of(const PixelRect& rect) {
  std::vector<PixelRect> tiles;
  for (int y = rect.y0; y < rect.y1; y += tile_size) {
    for (int x = rect.x0; x < rect.x1; x += tile_size) {
      tiles.push_back({x, std::min(x + tile_size, rect.x1), y, std::min(y + tile_size, rect.y1)});
    }
  }
  return tiles;
}

std::uint64_t total(const std::array<std::uint64_t, 3>& rays) {
  return rays[0] + rays[1] + rays[2];
}

void add(RenderCounts& sum, const RenderCounts& other) {
  for (std::size_t kind = 0; kind < sum.rays.size(); ++kind) {
    sum.rays[kind] += other.rays[kind];
    sum.traversal[kind] += other.traversal[kind];
  }
  sum.nan_samples += other.nan_samples;
}

// Lets oneTBB use more threads than processors if the caller asks for them.
std::unique_ptr<tbb::global_control> allowance_for(int threads) {
  if (threads <= tbb::this_task_arena::max_concurrency()) return nullptr;
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(threads));
}

void check_samples(int first, int count) {
  if (first < 0 || count < 1 || first > std::numeric_limits<int>::max() - count)
    throw std::invalid_argument("a pass cannot have " + std::to_string(count) +
                                " samples from sample " + std::to_string(first) + " on");
}

// Throws for a tile given twice: two threads would add to the same pixels.
void check_tiles(std::span<const std::size_t> tiles, std::size_t count) {
  std::vector<bool> given(count);
  for (const std::size_t tile : tiles) {
    if (tile >= count)
      throw std::invalid_argument("there is no tile " + std::to_string(tile) +
                                  ": the picture has " + std::to_string(count));
    if (given[tile])
      throw std::invalid_argument("tile " + std::to_string(tile) + " is given twice in one pass");
    given[tile] = true;
  }
}

std::string described(const PixelRect& rect) {
  return std::to_string(rect.width()) + " x " + std::to_string(rect.height()) + " pixels from (" +
         std::to_string(rect.x0) + ", " + std::to_string(rect.y0) + ")";
}

}  // namespace

struct RenderSession::Impl {
  Impl(const World& world, const Accelerator& accelerator, const FilmSettings& film_settings,
       const RenderSettings& settings, const SessionOptions& options)
      : film(black_film(pixels_of(film_settings), keeps_features(film_settings))),
        tiles(tiles_of(film.rect)),
        textures(world.textures),
        tracer(world, accelerator, textures, film_settings, settings, options.count_traversal),
        allowance(allowance_for(options.threads)),
        arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic),
        batches([this] { return tracer.make_batch(batch_capacity); }) {}

  // Traces a tile and returns the number of rays.
  std::uint64_t trace(std::size_t tile, int first_sample, int count) {
    PathBatch& batch = batches.local();
    const std::uint64_t rays_before = total(batch.counts.rays);
    for (int left = count; left > 0; left -= batch_samples) {
      tracer.trace(tiles[tile], first_sample + count - left, std::min(batch_samples, left), batch,
                   film);
    }
    return total(batch.counts.rays) - rays_before;
  }

  Film film;
  std::vector<PixelRect> tiles;
  TextureStore textures;
  PathTracer tracer;
  std::unique_ptr<tbb::global_control> allowance;
  tbb::task_arena arena;
  tbb::enumerable_thread_specific<PathBatch> batches;  // lent to a thread a tile at a time
};

RenderSession::RenderSession(const World& world, const Accelerator& accelerator,
                             const FilmSettings& film, const RenderSettings& settings,
                             const SessionOptions& options)
    : impl_(std::make_unique<Impl>(world, accelerator, film, settings, options)) {}
RenderSession::~RenderSession() = default;
RenderSession::RenderSession(RenderSession&& other) noexcept = default;
RenderSession& RenderSession::operator=(RenderSession&& other) noexcept = default;

std::span<const PixelRect> RenderSession::tiles() const { return impl_->tiles; }

std::vector<std::size_t> RenderSession::render_pass(std::span<const std::size_t> tiles,
                                                    int first_sample, int count,
                                                    const PassOptions& options) {
  check_samples(first_sample, count);
  check_tiles(tiles, impl_->tiles.size());
  std::vector<std::uint8_t> finished(tiles.size());
  const auto trace_tile = [&](std::size_t i) {
    if (options.stop != nullptr && options.stop->load()) return;
    const std::uint64_t rays = impl_->trace(tiles[i], first_sample, count);
    finished[i] = 1;
    if (options.on_tile) options.on_tile({tiles[i], rays});
  };
  impl_->arena.execute([&] { parallel_for(tiles.size(), 1, trace_tile); });
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (finished[i] != 0) result.push_back(tiles[i]);
  }
  return result;
}

const Film& RenderSession::film() const { return impl_->film; }

void RenderSession::restore(Film film) {
  const PixelRect& own = impl_->film.rect;
  const PixelRect& other = film.rect;
  if (other.x0 != own.x0 || other.x1 != own.x1 || other.y0 != own.y0 || other.y1 != own.y1)
    throw std::invalid_argument("a film of " + described(other) + " does not fit a picture of " +
                                described(own));
  if (film.pixels.size() != impl_->film.pixels.size())
    throw std::invalid_argument("a film of " + described(other) + " holds " +
                                std::to_string(film.pixels.size()));
  if (film.features.size() != impl_->film.features.size())
    throw std::invalid_argument("a film of " + described(other) + " holds features of " +
                                std::to_string(film.features.size()) + " in place of " +
                                std::to_string(impl_->film.features.size()));
  impl_->film = std::move(film);
}

Film RenderSession::take_film() && { return std::move(impl_->film); }

RenderCounts RenderSession::counts() const {
  RenderCounts sum;
  for (const PathBatch& batch : impl_->batches) add(sum, batch.counts);
  return sum;
}

}  // namespace pah
