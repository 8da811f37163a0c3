// A picture under way: samples are added to its film pass by pass, tile by tile.
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
  // Once set, no further tile is begun. Those begun are finished: the more samples a pass has, the
  // longer that takes.
  const std::atomic<bool>* stop = nullptr;
  // Called as each tile is finished, by the thread that did it, so by several at a time. It may
  // read the pixels of that tile, but no others. What it throws ends the pass and is thrown on; the
  // film may then hold tiles that nobody was told of.
  std::function<void(const FinishedTile&)> on_tile;
};

// A sample depends on the world, the settings, its pixel and its index alone, and a pixel's samples
// are summed as they are added. So a film is the same to the last bit however tiles and passes are
// split and ordered, whatever the number of threads, as long as every pixel gets its samples once
// and in ascending order: it is for the caller to see to that.
class RenderSession {
 public:
  // As many samples of a tile are traced together; passes of that many, or multiples, cost least.
  static constexpr int batch_samples = 16;

  // Opens the textures and prepares everything that rays need. The world and the accelerator must
  // outlive the session; all else is copied. settings.samples is left to whoever calls. Throws
  // std::runtime_error, naming the file, if a texture or an environment cannot be read.
  RenderSession(const World& world, const Accelerator& accelerator, const FilmSettings& film,
                const RenderSettings& settings, const SessionOptions& options = {});
  ~RenderSession();
  RenderSession(RenderSession&& other) noexcept;
  RenderSession& operator=(RenderSession&& other) noexcept;

  // Disjoint; together the pixels of the film. The same for the same film settings.
  [[nodiscard]] std::span<const PixelRect> tiles() const;

  // Adds the samples [first_sample, first_sample + count) of every pixel of the tiles, which are
  // indices in tiles(), to the film. Returns those that were finished, in the order given: all,
  // unless stopped. The others are untouched. One pass at a time. Throws std::invalid_argument,
  // with nothing done, for an index out of range or given twice, a negative first_sample, a count
  // below 1, or samples from 2^31 - 1 on.
  std::vector<std::size_t> render_pass(std::span<const std::size_t> tiles, int first_sample,
                                       int count, const PassOptions& options = {});

  // Not to be read during a pass, except as PassOptions::on_tile says.
  [[nodiscard]] const Film& film() const;

  // Goes on from a film of an earlier session; only its caller knows which samples it holds. Not
  // during a pass. Throws std::invalid_argument, and keeps the film that is there, if the other is
  // not of the same pixels, or keeps features where this does not.
  void restore(Film film);

  // The film, without a copy, of a session that is not needed any more.
  [[nodiscard]] Film take_film() &&;

  // What this session has done: nothing of what a restored film holds. Not during a pass.
  [[nodiscard]] RenderCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pah
