// What a render did, in numbers.
#pragma once

#include <array>
#include <cstdint>
#include <pah/bvh/traversal_counts.hpp>

namespace pah {

enum class RayKind { camera, shadow, bounce };
inline constexpr std::array<const char*, 3> ray_kind_names{"camera", "shadow", "bounce"};

struct RenderCounts {
  std::array<std::uint64_t, 3> rays{};         // by RayKind
  std::array<TraversalCounts, 3> traversal{};  // zero unless asked for
  std::uint64_t nan_samples = 0;               // samples dropped: not finite, or negative
};

}  // namespace pah
