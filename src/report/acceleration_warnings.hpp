// Warnings of useless influence areas and of too little memory.
#pragma once

#include <pah/render/acceleration.hpp>
#include <string>
#include <vector>

namespace pah {

// Returns one sentence for each declared area that holds no geometry or no rays of its light, or
// that is predicted to cost more than the global BVH; and one if the global BVH takes more memory
// than the scene allows.
[[nodiscard]] std::vector<std::string> warnings_of(const Acceleration& acceleration,
                                                   const World& world, const Scene& settings);

}  // namespace pah
