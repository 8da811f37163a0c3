#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <pah/load/load_scene.hpp>

#include "cli/terminal/exit_code.hpp"

namespace pah::cli {

// Applies the size on the command line; one side alone keeps the film's aspect ratio. Throws
// UsageError beyond the limits of scenes.
inline void resize(FilmSettings& film, std::optional<int> width, std::optional<int> height) {
  constexpr double max_side = 65536;
  const double scale = width    ? static_cast<double>(*width) / film.width
                       : height ? static_cast<double>(*height) / film.height
                                : 1;
  const double wide = width ? *width : std::max(1.0, std::round(film.width * scale));
  const double high = height ? *height : std::max(1.0, std::round(film.height * scale));
  if (wide > max_side || high > max_side)
    throw UsageError(fmt::format("a picture of {} x {} pixels is too large; a side has at most {}",
                                 wide, high, max_side));
  film.width = static_cast<int>(wide);
  film.height = static_cast<int>(high);
  const auto pixels = static_cast<std::uint64_t>(film.width) * static_cast<unsigned>(film.height);
  if (pixels > LoadLimits{}.film_pixels)
    throw UsageError(fmt::format("a picture of {} x {} pixels is too large; at most {} pixels",
                                 film.width, film.height, LoadLimits{}.film_pixels));
}

}  // namespace pah::cli
