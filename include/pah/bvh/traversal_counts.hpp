// Counters of the work that a batch of rays takes.
#pragma once

#include <cstdint>

namespace pah {

// Kernels without counting are compiled separately: they pay nothing for these.
struct TraversalCounts {
  std::uint64_t nodes = 0;        // inner nodes and leaves visited
  std::uint64_t inner_nodes = 0;  // inner nodes visited
  std::uint64_t triangles = 0;    // ray-triangle tests
  std::uint64_t blocks = 0;       // tests of up to four triangles side by side

  TraversalCounts& operator+=(const TraversalCounts& other) {
    nodes += other.nodes;
    inner_nodes += other.inner_nodes;
    triangles += other.triangles;
    blocks += other.blocks;
    return *this;
  }
};

}  // namespace pah
