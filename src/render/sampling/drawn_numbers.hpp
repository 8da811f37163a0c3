// Draws the next dimensions of several samplers at once.
#pragma once

#include <array>
#include <cstddef>

#include "render/sampling/sampler.hpp"

namespace pah {

class DrawnNumbers {
 public:
  static constexpr std::size_t lanes = 16, most_dimensions = 8;

  // Sets the sampler of a lane. Unused lanes draw numbers that are ignored.
  void set(std::size_t lane, const Sampler& sampler) {
    stream_[lane] = sampler.stream_;
    reversed_index_[lane] = sampler.reversed_index_;
    dimension_[lane] = sampler.dimension_;
  }
  // Draws the next `dimensions` of every lane's sampler, at most `most_dimensions`.
  void draw(std::size_t dimensions);

  [[nodiscard]] float x(std::size_t dimension, std::size_t lane) const {
    return x_[dimension][lane];
  }
  [[nodiscard]] Vec2 point(std::size_t dimension, std::size_t lane) const {
    return {x_[dimension][lane], y_[dimension][lane]};
  }

 private:
  template <typename Number>
  using Lanes = std::array<Number, lanes>;

  alignas(64) Lanes<std::uint64_t> stream_{};
  alignas(64) Lanes<std::uint32_t> reversed_index_{};
  alignas(64) Lanes<std::uint32_t> dimension_{};
  alignas(64) std::array<Lanes<float>, most_dimensions> x_{};
  alignas(64) std::array<Lanes<float>, most_dimensions> y_{};
};

// One lane's numbers, in the order in which its sampler would return them.
class NumberReader {
 public:
  NumberReader(const DrawnNumbers& numbers, std::size_t lane) : numbers_(numbers), lane_(lane) {}

  [[nodiscard]] float next_1d() { return numbers_.x(used_++, lane_); }
  [[nodiscard]] Vec2 next_2d() { return numbers_.point(used_++, lane_); }
  // The number of dimensions read, which the sampler must skip.
  [[nodiscard]] std::uint32_t used() const { return used_; }

 private:
  const DrawnNumbers& numbers_;
  std::size_t lane_;
  std::uint32_t used_ = 0;
};

}  // namespace pah
