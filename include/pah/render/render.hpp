// World and accelerator in, film out.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <pah/accel/accelerator.hpp>
#include <pah/render/counts.hpp>
#include <pah/render/film.hpp>
#include <pah/render/film_samples.hpp>
#include <pah/scene/world.hpp>

namespace pah {

struct Progress {
  double fraction = 0;  // of all samples that were to be rendered, in [0, 1]
  double seconds = 0;   // since the render began
  std::uint64_t rays = 0;
  int samples_finished = 0;  // per pixel, by every pixel
};

// What there is already. A film without pixels: nothing, and `samples` tells where to begin.
struct StartedFilm {
  Film film;
  FilmSamples samples;
};

struct RenderOptions {
  int threads = 0;        // 0: all
  double time_limit = 0;  // seconds; 0: none. Every pixel gets one sample, however long that takes
  bool count_traversal = false;
  const std::atomic<bool>* stop = nullptr;           // set it to end early with what there is
  std::function<void(const Progress&)> on_progress;  // called from one thread at a time
  // Called as each tile is finished by the thread that did it, so by several at a time; may read
  // the pixels of that tile but no others. Before that, called for each tile of a started film.
  // What it throws ends the render and is thrown on.
  std::function<void(const Film&, const PixelRect&)> on_tile;
  // Called after a pass over the picture, by the thread that called render(), while nothing changes
  // the film. Its time counts as the render's. What it throws ends the render and is thrown on.
  std::function<void(const Film&, const FilmSamples&, const Progress&)> on_pass;
  double pass_seconds = 0;  // of a pass at most, as far as whole samples allow; 0: as costs least
};

struct RenderResult {
  Film film;
  RenderCounts counts;
  double seconds = 0;
  int samples = 0;        // per pixel, held by every pixel
  bool complete = false;  // false if stopped or out of time
  FilmSamples held;
};

// Path-traces the world: adds the samples up to settings.samples to what there is. The same world,
// film, settings and accelerator answers give the same film to the last bit, whatever the number of
// threads and however often it was stopped and started again.
[[nodiscard]] RenderResult render(const World& world, const Accelerator& accelerator,
                                  const FilmSettings& film, const RenderSettings& settings,
                                  const RenderOptions& options = {}, StartedFilm started = {});

}  // namespace pah
