// Renders a world to a film.
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
  double fraction = 0;  // of all samples to be rendered, in [0, 1]
  double seconds = 0;   // since the render began
  std::uint64_t rays = 0;
  int samples_finished = 0;  // per pixel, by every pixel
};

// The film to continue. If it has no pixels, the render starts at samples.from.
struct StartedFilm {
  Film film;
  FilmSamples samples;
};

struct RenderOptions {
  int threads = 0;        // 0: all
  double time_limit = 0;  // seconds; 0: none. Every pixel gets one sample, however long that takes
  bool count_traversal = false;
  const std::atomic<bool>* stop = nullptr;  // set it to end early and keep the samples so far
  std::function<void(const Progress&)> on_progress;  // called from one thread at a time
  // Called when a tile is finished, by the thread that rendered it: several may call at a time. It
  // may read the pixels of that tile only. Before rendering it is called for each tile of a started
  // film. An exception ends the render and is rethrown.
  std::function<void(const Film&, const PixelRect&)> on_tile;
  // Called after a pass over the picture by the thread that called render(), while nothing changes
  // the film. Its time is part of the render's. An exception ends the render and is rethrown.
  std::function<void(const Film&, const FilmSamples&, const Progress&)> on_pass;
  double pass_seconds =
      0;  // most of a pass, if it has more than one sample; 0: the cheapest passes
};

struct RenderResult {
  Film film;
  RenderCounts counts;
  double seconds = 0;
  int samples = 0;        // per pixel, held by every pixel
  bool complete = false;  // false if stopped or out of time
  FilmSamples held;
};

// Path-traces the world: adds the samples up to settings.samples to the started film. The same
// world, settings and answers of the accelerator give the same film to the last bit, for any number
// of threads and any number of interruptions.
[[nodiscard]] RenderResult render(const World& world, const Accelerator& accelerator,
                                  const FilmSettings& film, const RenderSettings& settings,
                                  const RenderOptions& options = {}, StartedFilm started = {});

}  // namespace pah
