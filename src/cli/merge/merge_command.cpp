#include "cli/merge/merge_command.hpp"

#include <fmt/format.h>

#include <string>

#include "cli/merge/film_picture.hpp"
#include "cli/merge/parts.hpp"
#include "cli/terminal/console.hpp"

namespace pah::cli {

ExitCode run_merge(const MergeArguments& arguments) {
  const std::filesystem::path& output = arguments.output;
  check_output(output);
  const Parts parts = read_parts(arguments.parts);
  if (parts.from > 0 && !is_film_file(output)) fail_for_gap(0, parts.from);

  const Film film = sum_of(parts);
  FilmOrigin origin = parts.parts.front().origin;
  origin.film.crop = parts.rect;
  origin.film.exposure = arguments.exposure.value_or(origin.film.exposure);
  origin.render.samples = parts.to;
  if (is_film_file(output))
    write_film(output, origin, {parts.from, parts.to, 0, {}}, film);
  else
    write_image(output, layers_of(film, origin.film), write_options(origin, parts.to, {}));
  const std::size_t count = parts.parts.size();
  say(fmt::format("wrote {}: {} x {}, {} samples of {}\n", output.string(), film.rect.width(),
                  film.rect.height(), parts.to - parts.from,
                  count == 1 ? "1 file" : fmt::format("{} files", count)));
  const FilmSettings& whole = origin.film;
  if (film.rect.width() < whole.width || film.rect.height() < whole.height)
    say(fmt::format("these are the pixels {},{},{},{} of {} x {}\n", film.rect.x0, film.rect.x1,
                    film.rect.y0, film.rect.y1, whole.width, whole.height));
  return ExitCode::done;
}

}  // namespace pah::cli
