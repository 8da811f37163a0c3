#include "cli/render/checkpoint.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "cli/terminal/console.hpp"

namespace pah::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& why, const std::string& remedy) {
  throw FileError(fmt::format("cannot resume from {}: {}; {}", file.string(), why, remedy));
}

void check_samples(const fs::path& file, const FilmSamples& held, int from, int samples) {
  if (held.from != from)
    refuse(file, fmt::format("its first sample is {}, not {}", held.from, from),
           "give the same --samples, or start over without --resume");
  const int last = held.to + held.ahead;
  if (last > samples)
    refuse(file, fmt::format("it has samples up to {}, more than the {} asked for", last, samples),
           "ask for at least as many, or start over without --resume");
}

}  // namespace

Checkpoint::Checkpoint(const fs::path& picture, FilmOrigin origin, const CheckpointOptions& options,
                       Warnings& warnings)
    : file_(picture.string() + film_extension),
      origin_(std::move(origin)),
      options_(options),
      warnings_(warnings) {}

StartedFilm Checkpoint::start(int from) {
  std::error_code ignored;
  const bool kept = fs::exists(file_, ignored);
  if (options_.resume && kept) return resume(from);
  if (options_.resume && !options_.quiet)
    say(fmt::format("{} does not exist; starting from the beginning\n", file_.string()));
  if (options_.interval && kept)
    warnings_.add(fmt::format(
        "{} holds an unfinished render and will be replaced; use --resume to continue it",
        file_.string()));
  return {{}, {from, from, 0, {}}};
}

StartedFilm Checkpoint::resume(int from) const {
  FilmFile kept = read_film(file_);
  const std::vector<std::string> differing = differences(kept.origin, origin_);
  if (!differing.empty())
    refuse(file_, fmt::format("{}", fmt::join(differing, ", ")),
           "use the same settings, or start over without --resume");
  check_samples(file_, kept.samples, from, origin_.render.samples);
  if (!options_.quiet)
    say(fmt::format("resuming from {}: {} samples\n", file_.string(),
                    kept.samples.to - kept.samples.from));
  return {std::move(kept.film), std::move(kept.samples)};
}

void Checkpoint::pass_done(const Film& film, const FilmSamples& samples) {
  if (!options_.interval) return;
  const bool last = samples.to == origin_.render.samples;
  if (last || since_written_.seconds() < *options_.interval) return;
  write(film, samples);
  since_written_ = {};
}

void Checkpoint::keep(const Film& film, const FilmSamples& samples) {
  const bool empty = samples.to == samples.from && samples.behind.empty();
  if (!options_.interval || empty || !write(film, samples) || options_.quiet) return;
  say(fmt::format("wrote {}; --resume continues from it\n", file_.string()));
}

void Checkpoint::remove() const {
  if (!options_.interval && !options_.resume) return;
  std::error_code ignored;
  fs::remove(file_, ignored);
}

bool Checkpoint::write(const Film& film, const FilmSamples& samples) {
  try {
    write_film(file_, origin_, samples, film);
    return true;
  } catch (const FileError& error) {
    if (!warned_) warnings_.add(fmt::format("{}; the render continues", error.what()));
    warned_ = true;
    return false;
  }
}

}  // namespace pah::cli
