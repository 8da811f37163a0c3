// How much work a batch of rays was.
#pragma once

#include <cstdint>

namespace pah {

// Counting is compiled out where no counts are asked for.
struct TraversalCounts {
  std::uint64_t nodes = 0;        // inner nodes and leaves visited
  std::uint64_t inner_nodes = 0;  // of these
  std::uint64_t triangles = 0;    // ray-triangle tests
  std::uint64_t blocks = 0;       // of up to four triangles, tested side by side

  TraversalCounts& operator+=(const TraversalCounts& other) {
    nodes += other.nodes;
    inner_nodes += other.inner_nodes;
    triangles += other.triangles;
    blocks += other.blocks;
    return *this;
  }
};

}  // namespace pah
