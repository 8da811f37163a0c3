// Counters of a render.
#pragma once

#include <array>
#include <cstdint>
#include <pah/bvh/traversal_counts.hpp>

namespace pah {

enum class RayKind { camera, shadow, bounce };
inline constexpr std::array<const char*, 3> ray_kind_names{"camera", "shadow", "bounce"};

struct RenderCounts {
  std::array<std::uint64_t, 3> rays{};         // by RayKind
  std::array<TraversalCounts, 3> traversal{};  // zero unless RenderOptions::count_traversal
  std::uint64_t nan_samples = 0;  // samples that were dropped as not finite or negative
};

}  // namespace pah
