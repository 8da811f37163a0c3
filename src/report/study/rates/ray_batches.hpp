// Rays in the batches of a renderer: many to a call.
#pragma once

#include <pah/geometry/ray.hpp>
#include <span>
#include <vector>

namespace pah {

struct RayBatches {
  std::vector<Ray> rays;
  std::vector<std::size_t> ends;  // of each batch, in `rays`

  void add(std::span<const Ray> batch) {
    if (batch.empty()) return;
    rays.insert(rays.end(), batch.begin(), batch.end());
    ends.push_back(rays.size());
  }
  [[nodiscard]] std::size_t first_of(std::size_t batch) const {
    return batch > 0 ? ends[batch - 1] : 0;
  }
  [[nodiscard]] std::span<const Ray> batch(std::size_t i) const {
    return std::span(rays).subspan(first_of(i), ends[i] - first_of(i));
  }
};

}  // namespace pah
