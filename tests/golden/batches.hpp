// A picture as the mean of independent renders, with the variance between them.
//
// The samples of one pixel of one render come from a scrambled low-discrepancy sequence: they are
// not independent, and their variance overestimates the error of their mean. Renders with different
// seeds are independent, so the variance between such batches is unbiased.
#pragma once

#include <cstdint>
#include <pah/accel/accelerator.hpp>
#include <pah/scene/scene.hpp>
#include <vector>

namespace pah::golden {

class Batches {
 public:
  Batches(int width, int height);
  // From what was stored; `variance` as variance() gives it.
  Batches(int width, int height, int count, std::vector<DVec3> mean,
          const std::vector<DVec3>& variance);

  // `picture` holds width * height pixels.
  void add(const std::vector<DVec3>& picture);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const std::vector<DVec3>& mean() const { return mean_; }
  // Of one batch, unbiased; needs two batches at least.
  [[nodiscard]] DVec3 variance(std::size_t pixel) const {
    return squares_[pixel] / static_cast<double>(count_ - 1);
  }

 private:
  int width_, height_;
  int count_ = 0;
  std::vector<DVec3> mean_;
  std::vector<DVec3> squares_;  // of the deviations from the mean, summed
};

// Renders the scene with its own sample count per batch and the seeds from `first_seed` on. Throws
// std::runtime_error if a sample is not finite.
[[nodiscard]] Batches render_batches(
    const Scene& scene, std::uint64_t first_seed, int count,
    std::unique_ptr<Accelerator> (*make_accelerator)(Triangles) = make_global_bvh);

}  // namespace pah::golden
