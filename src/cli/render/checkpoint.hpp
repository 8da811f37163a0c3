// The film of a render under way, kept in a file beside its picture.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <pah/render/film_file.hpp>
#include <pah/render/render.hpp>

#include "cli/terminal/warnings.hpp"

namespace pah::cli {

struct CheckpointOptions {
  std::optional<double> interval;  // seconds; none: nothing is kept
  bool resume = false;             // go on from what is kept
  bool quiet = false;
};

class Checkpoint {
 public:
  Checkpoint(const std::filesystem::path& picture, FilmOrigin origin,
             const CheckpointOptions& options, Warnings& warnings);

  // What is kept, or nothing yet, as from sample `from` on. Throws FileError if what is kept is not
  // of this render.
  [[nodiscard]] StartedFilm start(int from);

  // Whatever cannot be written is warned of once; rendering is worth more.
  void pass_done(const Film& film, const FilmSamples& samples);
  // Of a render that was stopped.
  void keep(const Film& film, const FilmSamples& samples);

  // There is a whole picture.
  void remove() const;

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] StartedFilm resume(int from) const;
  bool write(const Film& film, const FilmSamples& samples);

  std::filesystem::path file_;
  FilmOrigin origin_;
  CheckpointOptions options_;
  Warnings& warnings_;
  bool warned_ = false;
  Clock::time_point written_ = Clock::now();
};

}  // namespace pah::cli
