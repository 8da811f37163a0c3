// Items that the builder sorts: a box and its index in 32 bytes, laid out for vector instructions.
#pragma once

#include <cstdint>
#include <limits>
#include <pah/geometry/aabb.hpp>

#include "geometry/float4.hpp"

namespace pah {

// The fourth lanes are unused.
struct Box4 {
  Float4 min, max;

  static Box4 empty() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {splat(infinity), splat(-infinity)};
  }
  [[gnu::always_inline]] void extend(Float4 point) {
    min = pah::min(min, point);
    max = pah::max(max, point);
  }
  [[gnu::always_inline]] void extend(const Box4& other) {
    min = pah::min(min, other.min);
    max = pah::max(max, other.max);
  }
  [[nodiscard]] Aabb aabb() const { return {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}}; }
};

struct Item {
  Box4 box;  // the fourth lane of its minimum holds the index

  Item() = default;
  Item(const Aabb& bounds, std::uint32_t index)
      : box{float4(bounds.min, std::bit_cast<float>(index)), float4(bounds.max)} {}

  [[nodiscard]] std::uint32_t index() const {
    return static_cast<std::uint32_t>(std::bit_cast<Int4>(box.min)[3]);
  }
  // Rounds as Aabb::center() does. The index is masked out: as a float it is denormal, and slow to
  // multiply.
  [[nodiscard, gnu::always_inline]] Float4 centroid() const {
    const auto low = std::bit_cast<Float4>(std::bit_cast<Int4>(box.min) & Int4{-1, -1, -1, 0});
    return 0.5F * low + 0.5F * box.max;
  }
};

}  // namespace pah
