// A render that its caller drives: adds samples to a film pass by pass, tile by tile.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <pah/accel/accelerator.hpp>
#include <pah/render/counts.hpp>
#include <pah/render/film.hpp>
#include <pah/scene/world.hpp>
#include <span>
#include <vector>

namespace pah {

struct SessionOptions {
  int threads = 0;  // 0: all
  bool count_traversal = false;
};

// A tile that has all samples of a pass.
struct FinishedTile {
  std::size_t index = 0;   // in RenderSession::tiles()
  std::uint64_t rays = 0;  // traced for it in this pass
};

struct PassOptions {
  // Once set, no further tile is started. Started tiles are finished, which takes longer the more
  // samples the pass has.
  const std::atomic<bool>* stop = nullptr;
  // Called when a tile is finished, by the thread that rendered it: several may call at a time. It
  // may read the pixels of that tile only. An exception ends the pass and is rethrown; the film may
  // then hold finished tiles that were not reported.
  std::function<void(const FinishedTile&)> on_tile;
};

// A sample depends on the world, the settings, its pixel and its index alone. So neither the split
// into tiles and passes nor the number of threads changes a bit of the film, as long as every pixel
// receives each sample once and in ascending order. The caller must ensure this.
class RenderSession {
 public:
  // The number of samples of a tile that are traced together: passes of a multiple cost least.
  static constexpr int batch_samples = 16;

  // Opens the textures and prepares the lights. The world and the accelerator must outlive the
  // session; everything else is copied. settings.samples is ignored. Throws
  // std::runtime_error, naming the file, if a texture or an environment cannot be read.
  RenderSession(const World& world, const Accelerator& accelerator, const FilmSettings& film,
                const RenderSettings& settings, const SessionOptions& options = {});
  ~RenderSession();
  RenderSession(RenderSession&& other) noexcept;
  RenderSession& operator=(RenderSession&& other) noexcept;

  // Disjoint rectangles that cover the film. They depend on the film settings alone.
  [[nodiscard]] std::span<const PixelRect> tiles() const;

  // Adds the samples [first_sample, first_sample + count) of every pixel of the tiles, which are
  // indices in tiles(), to the film. Returns those that were finished, in the order given: all,
  // unless stopped. The others are untouched. One pass at a time. Throws std::invalid_argument,
  // with nothing done, for an index out of range or given twice, a negative first_sample, a count
  // below 1, or samples from 2^31 - 1 on.
  std::vector<std::size_t> render_pass(std::span<const std::size_t> tiles, int first_sample,
                                       int count, const PassOptions& options = {});

  // Do not read it during a pass, except as PassOptions::on_tile says.
  [[nodiscard]] const Film& film() const;

  // Replaces the film by one of an earlier session. The caller keeps track of the samples that it
  // holds. Not during a pass. Throws std::invalid_argument, without a change, if the film covers
  // other pixels, or only one of the two keeps features.
  void restore(Film film);

  // Moves the film out of a session that is no longer needed.
  [[nodiscard]] Film take_film() &&;

  // The counters of this session, without those of a restored film. Not during a pass.
  [[nodiscard]] RenderCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pah
