// Tests the callbacks between the passes of a render, and the length of passes.
#include <algorithm>
#include <limits>
#include <mutex>
#include <pah/render/render.hpp>
#include <stdexcept>
#include <thread>

#include "analytic_scenes.hpp"
#include "catch.hpp"

using namespace pah;
using namespace pah::test;

namespace {

Scene ball() {
  SceneBuilder builder;
  builder.add(SphereShape{1, 16, 8}, builder.diffuse(0.5F));
  builder.light(EnvironmentLight{Vec3(1)});
  builder.look({0, 0, 4}, {0, 0, 0}, 40);
  builder.film(48, 50);
  return builder.scene;
}

bool has_samples(const Film& film, int samples) {
  return std::ranges::all_of(film.pixels, [&](const FilmPixel& pixel) {
    return pixel.samples == static_cast<std::uint32_t>(samples);
  });
}

// Returns the number of samples in the film after each pass.
std::vector<int> samples_after_passes(RenderOptions options) {
  std::vector<int> samples;
  const std::thread::id thread = std::this_thread::get_id();
  options.on_pass = [&](const Film& film, const FilmSamples&, const Progress& progress) {
    CHECK(std::this_thread::get_id() == thread);
    CHECK(has_samples(film, progress.samples_finished));
    samples.push_back(progress.samples_finished);
  };
  CHECK(identical(render_scene(ball(), options).film, render_scene(ball()).film));
  return samples;
}

}  // namespace

TEST_CASE("After a pass every pixel has as many samples", "[threads]") {
  CHECK(samples_after_passes({}) == std::vector<int>{1, 2, 4, 8, 16, 32, 48, 50});
}

TEST_CASE("Passes are as short as requested, down to one sample", "[threads]") {
  RenderOptions options;
  options.pass_seconds = 1e-9;
  CHECK(samples_after_passes(options).size() == 50);
  options.pass_seconds = 1e9;
  CHECK(samples_after_passes(options).size() == 8);
}

TEST_CASE("A render can be ended between passes", "[threads]") {
  RenderOptions options;
  std::atomic<bool> stop = false;
  options.stop = &stop;
  options.on_pass = [&](const Film&, const FilmSamples&, const Progress& progress) {
    if (progress.samples_finished == 4) stop = true;
  };
  const RenderResult stopped = render_scene(ball(), options);
  CHECK(stopped.samples == 4);
  CHECK(has_samples(stopped.film, 4));
  options.on_pass = [](const Film&, const FilmSamples&, const Progress&) {
    throw std::runtime_error("enough");
  };
  stop = false;
  CHECK_THROWS_WITH(render_scene(ball(), options), "enough");
}

TEST_CASE("Each tile is reported once a pass, with its samples", "[threads]") {
  std::mutex mutex;
  int finished = 0;  // samples of every pixel
  std::size_t pixels = 0;
  int wrong = 0;
  RenderOptions options;
  options.on_tile = [&](const Film& film, const PixelRect& tile) {
    int fewest = std::numeric_limits<int>::max();
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        fewest = std::min(fewest, static_cast<int>(film.at(x, y).samples));
    const std::lock_guard lock(mutex);
    pixels += static_cast<std::size_t>(tile.width()) * static_cast<std::size_t>(tile.height());
    if (fewest <= finished) ++wrong;
  };
  options.on_pass = [&](const Film& film, const FilmSamples&, const Progress& progress) {
    CHECK(pixels == film.pixels.size());
    finished = progress.samples_finished;
    pixels = 0;
  };
  const RenderResult result = render_scene(ball(), options);
  CHECK(finished == 50);
  CHECK(wrong == 0);
  CHECK(identical(result.film, render_scene(ball()).film));
}
