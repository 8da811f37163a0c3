// Whether there is memory for what a picture takes.
#pragma once

#include <pah/scene/settings.hpp>

namespace pah::cli {

// Throws std::runtime_error, in plain words, if the film alone takes more than there is.
void check_memory_for(const FilmSettings& film);

}  // namespace pah::cli
