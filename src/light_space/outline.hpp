// What the light sees of a triangle on one face: a convex polygon, and how far a hit of the
// triangle may appear from it.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <pah/geometry/triangles.hpp>

#include "light_space/light_view.hpp"

namespace pah {

struct Outline {
  static constexpr std::size_t most_vertices = 3 + 5;

  std::array<DVec2, most_vertices> vertices;
  std::size_t size = 0;
  double margin = 0;   // along u and v
  double nearest = 0;  // depth
  // A function of the place, linear in u and v, that bounds depths from below: depth itself where
  // rays are parallel, its reciprocal (from above) where they meet in a point.
  DVec2 slope{0};
  double offset = 0;

  // Along u or v, widened by the margin.
  [[nodiscard]] Range range(int axis) const {
    Range range;
    for (std::size_t i = 0; i < size; ++i) range.extend(vertices[i][axis]);
    return {range.min - margin, range.max + margin};
  }
};

// What is nearer to a point light than this many errors has no place on a face: errors would move
// it across the whole of it.
inline constexpr double nearest_on_faces = 64;

// Along u and v, where rays meet in a point: see below.
[[nodiscard]] inline double margin_at(double depth, double error) { return 2.25 * error / depth; }

// What is seen of a triangle on a face, if anything. `error` is how far from the triangle, along
// every axis of the face, a ray may be that is found to hit it. Where rays meet in a point, that
// moves what is seen of a point (x, y, z), with |x| and |y| of at most 17/16 z, by
// (ex - x/z ez) / (z + ez), which is less than 2.25 errors / z for z of at least 64 errors. The
// polygon is cut off there, and where |x| or |y| is 17/16 z: 2 errors are at most 1/32 z.
[[nodiscard]] std::optional<Outline> outline_on(const ParallelView& view, int face,
                                                const Triangle& triangle, double error);
[[nodiscard]] std::optional<Outline> outline_on(const CubeView& view, int face,
                                                const Triangle& triangle, double error);

// The range of u that the polygon, widened by its margin, has where v is in a range.
[[nodiscard]] Range across(const Outline& outline, const Range& v);

}  // namespace pah
