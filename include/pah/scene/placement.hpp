// Transforms that repeat and scatter copies of an instance. The same numbers give the same
// transforms on every platform.
#pragma once

#include <cstdint>
#include <pah/scene/mesh.hpp>
#include <variant>
#include <vector>

namespace pah {

// The transform that applies `b_from_a`, then `c_from_b`.
[[nodiscard]] glm::dmat4x3 compose(const glm::dmat4x3& c_from_b, const glm::dmat4x3& b_from_a);

// Copy i stands at i * step.
struct LineRepeat {
  std::uint32_t count = 1;
  DVec3 step{1, 0, 0};
};

// count.x * count.y * count.z copies; x runs fastest.
struct GridRepeat {
  UVec3 count{1, 1, 1};
  DVec3 step{1, 1, 1};
  bool centered = false;  // about the origin, else from the origin on
};

// Around the y axis, copy i at angle start + i * 360 / count from +x towards -z (counterclockwise
// from above).
struct RingRepeat {
  std::uint32_t count = 1;
  double radius = 1;
  double start = 0;  // degrees
  bool turn = true;  // copies turn with the angle; else all face one way
};

using Repeat = std::variant<LineRepeat, GridRepeat, RingRepeat>;

// What scattering does to each copy. Copies stand upright, turned at random about y.
struct ScatterOptions {
  std::uint32_t count = 1;
  std::uint64_t seed = 0;
  bool turn = true;         // by a random angle about the copy's own up axis
  DVec2 scale{1, 1};        // a uniform random factor between these, both > 0
  double min_distance = 0;  // between copies' positions; fewer than `count` copies may fit then
  bool align = false;       // over a mesh: the copy's up axis follows the surface's normal
};

// The number of copies that place() would make, to be checked against a limit first.
[[nodiscard]] std::uint64_t count_of(const Repeat& repeat);

// One transform a copy. Throws std::invalid_argument on a count of 0 or values that are not finite.
[[nodiscard]] std::vector<glm::dmat4x3> place(const Repeat& repeat);

// Over the rectangle of `size` in the xz plane, centered on the origin.
[[nodiscard]] std::vector<glm::dmat4x3> scatter(const DVec2& size, const ScatterOptions& options);

// Over the surface of a mesh that stands at `world_from_object`, uniformly by area.
[[nodiscard]] std::vector<glm::dmat4x3> scatter(const Mesh& mesh,
                                                const glm::dmat4x3& world_from_object,
                                                const ScatterOptions& options);

}  // namespace pah
