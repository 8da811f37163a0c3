// Checks that a picture fits into memory.
#pragma once

#include <pah/scene/settings.hpp>

namespace pah::cli {

// Throws std::runtime_error, with a message for users, if the film alone exceeds the free memory.
void check_memory_for(const FilmSettings& film);

}  // namespace pah::cli
