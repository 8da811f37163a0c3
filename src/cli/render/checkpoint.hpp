// Saves the state of a running render to a film file beside its picture.
#pragma once

#include <filesystem>
#include <optional>
#include <pah/render/film_file.hpp>
#include <pah/render/render.hpp>

#include "base/stopwatch.hpp"
#include "cli/terminal/warnings.hpp"

namespace pah::cli {

struct CheckpointOptions {
  std::optional<double> interval;  // seconds; without it nothing is saved
  bool resume = false;             // continue from the saved film
  bool quiet = false;
};

class Checkpoint {
 public:
  Checkpoint(const std::filesystem::path& picture, FilmOrigin origin,
             const CheckpointOptions& options, Warnings& warnings);

  // Returns the saved film, or an empty one that starts at sample `from`. Throws FileError if the
  // saved film belongs to another render.
  [[nodiscard]] StartedFilm start(int from);

  // Saves the film if it is time to. A failure causes one warning, because the render is worth
  // more.
  void pass_done(const Film& film, const FilmSamples& samples);
  // Saves the film of a stopped render.
  void keep(const Film& film, const FilmSamples& samples);

  // Removes the file, once the picture is complete.
  void remove() const;

 private:
  [[nodiscard]] StartedFilm resume(int from) const;
  bool write(const Film& film, const FilmSamples& samples);

  std::filesystem::path file_;
  FilmOrigin origin_;
  CheckpointOptions options_;
  Warnings& warnings_;
  bool warned_ = false;
  Stopwatch since_written_;
};

}  // namespace pah::cli
