// What accelerators answer, and where two of them differ.
#pragma once

#include <pah/accel/accelerator.hpp>

#include "report/study/rates/ray_batches.hpp"

namespace pah {

enum class RayQuery : std::uint8_t { nearest, any };

// Of either query, the answers to all rays.
struct Answers {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> occluded;

  // Makes room.
  void reserve(RayQuery query, std::size_t rays);
};

// Asks for one batch; answers[first] becomes the first.
void ask(const Accelerator& accelerator, RayQuery query, std::span<const Ray> rays,
         Answers& answers, std::size_t first, TraversalCounts* counts = nullptr);

[[nodiscard]] Answers ask_all(const Accelerator& accelerator, RayQuery query,
                              const RayBatches& batches, TraversalCounts* counts = nullptr);

// Two triangles are a tie if their distances are so nearly the same, relative to the larger: a ray
// through a shared edge meets both.
inline constexpr float tie = 1e-5F;

// Rays that only one of both says hit, or whose nearest triangles differ but for ties.
[[nodiscard]] std::uint64_t count_mismatches(RayQuery query, const Answers& a, const Answers& b);

}  // namespace pah
