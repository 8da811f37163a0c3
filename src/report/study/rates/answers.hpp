// The answers of accelerators, and their differences.
#pragma once

#include <pah/accel/accelerator.hpp>

#include "report/study/rates/ray_batches.hpp"

namespace pah {

enum class RayQuery : std::uint8_t { nearest, any };

// The answers to all rays, of either query.
struct Answers {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> occluded;

  // Reserves memory.
  void reserve(RayQuery query, std::size_t rays);
};

// Traces one batch; its answers start at index `first`.
void ask(const Accelerator& accelerator, RayQuery query, std::span<const Ray> rays,
         Answers& answers, std::size_t first, TraversalCounts* counts = nullptr);

[[nodiscard]] Answers ask_all(const Accelerator& accelerator, RayQuery query,
                              const RayBatches& batches, TraversalCounts* counts = nullptr);

// Two triangles tie if their distances differ by less, relative to the larger: a ray through a
// shared edge meets both.
inline constexpr float tie = 1e-5F;

// Counts the rays for which only one of the two reports a hit, or whose nearest triangles differ
// without a tie.
[[nodiscard]] std::uint64_t count_mismatches(RayQuery query, const Answers& a, const Answers& b);

}  // namespace pah
