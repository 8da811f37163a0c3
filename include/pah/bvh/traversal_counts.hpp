// How much work a batch of rays was.
#pragma once

#include <cstdint>

namespace pah {

// Counting is compiled out where no counts are asked for.
struct TraversalCounts {
  std::uint64_t nodes = 0;      // inner nodes and leaves visited
  std::uint64_t triangles = 0;  // ray-triangle tests
};

}  // namespace pah
