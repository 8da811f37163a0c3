#pragma once

#include <fmt/format.h>

#include <pah/io/load_scene.hpp>

#include "cli/exit_code.hpp"

namespace pah::cli {

// What the command line may ask for is bounded as what a scene may. Throws UsageError.
inline void check_size(const FilmSettings& film) {
  const auto pixels = static_cast<std::uint64_t>(film.width) * static_cast<unsigned>(film.height);
  if (pixels > LoadLimits{}.film_pixels)
    throw UsageError(fmt::format("a picture of {} x {} pixels is too large; at most {} pixels",
                                 film.width, film.height, LoadLimits{}.film_pixels));
}

}  // namespace pah::cli
