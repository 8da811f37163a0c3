// Influence areas that were declared in vain, and memory that does not suffice.
#pragma once

#include <pah/render/acceleration.hpp>
#include <string>
#include <vector>

namespace pah {

// One sentence each, of declared areas that were built: no geometry in them, no rays of their
// light, or a higher predicted cost than without; and of a BVH of the whole scene that takes more
// memory than the scene allows.
[[nodiscard]] std::vector<std::string> warnings_of(const Acceleration& acceleration,
                                                   const World& world, const Scene& settings);

}  // namespace pah
