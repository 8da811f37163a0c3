// Settings for a small, rough picture of the same view.
#pragma once

#include <pah/scene/settings.hpp>

namespace pah::cli {

constexpr int preview_samples = 4;

// Returns a quarter of the width and height, rounded up. A crop becomes the pixels that cover it.
[[nodiscard]] FilmSettings preview_of(FilmSettings film);

}  // namespace pah::cli
