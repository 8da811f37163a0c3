#include "cli/merge_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "cli/console.hpp"
#include "cli/film_picture.hpp"

namespace pah::cli {
namespace {

namespace fs = std::filesystem;

struct Part {
  fs::path file;
  FilmOrigin origin;
  FilmSamples samples;
};

// Only one film is in memory at a time.
Part read_part(const fs::path& file) {
  FilmFile film = read_film(file);
  if (!film.samples.behind.empty())
    throw FileError(
        fmt::format("{} was stopped in the midst of a pass: some of its pixels lack samples; "
                    "render it again",
                    file.string()));
  if (film.samples.from == film.samples.to)
    throw FileError(fmt::format("{} has no samples; render it again", file.string()));
  return {file, std::move(film.origin), std::move(film.samples)};
}

void check_origin(const Part& part, const Part& first) {
  const std::vector<std::string> differing = differences(part.origin, first.origin);
  if (!differing.empty())
    throw FileError(fmt::format("{} does not go with {}: {}; parts of one picture agree in these",
                                part.file.string(), first.file.string(),
                                fmt::join(differing, ", ")));
}

[[noreturn]] void fail_for_gap(int from, int to) {
  const std::string missing = to - from == 1 ? fmt::format("sample {} is", from)
                                             : fmt::format("samples {} to {} are", from, to - 1);
  throw FileError(
      fmt::format("{} missing; render what is missing by --samples {}:{}", missing, from, to));
}

void check_neighbors(const Part& part, const Part& next) {
  if (next.samples.from > part.samples.to) fail_for_gap(part.samples.to, next.samples.from);
  if (next.samples.from < part.samples.to)
    throw FileError(fmt::format(
        "{} and {} overlap: both have sample {}; leave out one, or render it anew by --samples",
        part.file.string(), next.file.string(), next.samples.from));
}

// In the order of their samples, so that the order given does not matter.
std::vector<Part> read_parts(const std::vector<fs::path>& files) {
  std::vector<Part> parts;
  for (const fs::path& file : files) {
    parts.push_back(read_part(file));
    check_origin(parts.back(), parts.front());
  }
  std::ranges::sort(parts, {},
                    [](const Part& part) { return std::pair(part.samples.from, part.samples.to); });
  for (std::size_t i = 1; i < parts.size(); ++i) check_neighbors(parts[i - 1], parts[i]);
  return parts;
}

Film sum_of(const std::vector<Part>& parts) {
  Film sum = read_film(parts.front().file).film;
  for (std::size_t i = 1; i < parts.size(); ++i) add(sum, read_film(parts[i].file).film);
  return sum;
}

}  // namespace

ExitCode run_merge(const MergeArguments& arguments) {
  const fs::path& output = arguments.output;
  check_output(output);
  const std::vector<Part> parts = read_parts(arguments.parts);
  const int from = parts.front().samples.from;
  const int to = parts.back().samples.to;
  if (from > 0 && !is_film_file(output)) fail_for_gap(0, from);

  const Film film = sum_of(parts);
  FilmOrigin origin = parts.front().origin;
  origin.film.exposure = arguments.exposure.value_or(origin.film.exposure);
  origin.render.samples = to;
  if (is_film_file(output))
    write_film(output, origin, {from, to, 0, {}}, film);
  else
    write_image(output, layers_of(film, origin.film), write_options(origin, to, {}));
  say(fmt::format("wrote {}: {} x {}, {} samples of {}\n", output.string(), film.rect.width(),
                  film.rect.height(), to - from,
                  parts.size() == 1 ? "1 file" : fmt::format("{} files", parts.size())));
  return ExitCode::done;
}

}  // namespace pah::cli
