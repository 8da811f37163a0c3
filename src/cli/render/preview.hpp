// A small, rough picture of the same view.
#pragma once

#include <pah/scene/settings.hpp>

namespace pah::cli {

constexpr int preview_samples = 4;

// A quarter of the width and of the height, rounded up; of a crop, the pixels that its own cover.
[[nodiscard]] FilmSettings preview_of(FilmSettings film);

}  // namespace pah::cli
