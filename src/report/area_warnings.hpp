// Influence areas that were declared in vain.
#pragma once

#include <pah/render/acceleration.hpp>
#include <string>
#include <vector>

namespace pah {

// One sentence each, of declared areas that were built: no geometry in them, no rays of their
// light, or a higher predicted cost than without.
[[nodiscard]] std::vector<std::string> warnings_of(const Acceleration& acceleration,
                                                   const World& world, const FilmSettings& film);

}  // namespace pah
