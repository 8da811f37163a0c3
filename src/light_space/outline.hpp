// The outline of a triangle on one face of the light's view: a convex polygon, and a bound on how
// far outside of it a hit on the triangle may appear.
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
  double nearest = 0;  // the least depth
  // offset + dot(slope, (u, v)) bounds depth from below for parallel rays. For rays through a point
  // it bounds 1 / depth from above.
  DVec2 slope{0};
  double offset = 0;

  // The polygon's extent along u (axis 0) or v (axis 1), widened by the margin.
  [[nodiscard]] Interval range(int axis) const {
    Interval range;
    for (std::size_t i = 0; i < size; ++i) range.extend(vertices[i][axis]);
    return {range.min - margin, range.max + margin};
  }
};

// A point nearer to a point light than this many errors has no place on a face: an error could move
// it across the whole face.
inline constexpr double nearest_on_faces = 64;

// The margin along u and v on a cube's face: see outline_on().
[[nodiscard]] inline double margin_at(double depth, double error) { return 2.25 * error / depth; }

// The outline of a triangle on a face; nothing if the face does not see it. `error` bounds, along
// every axis of the face, the distance from the triangle of a ray that is found to hit it. On a
// cube's face such an error (ex, ey, ez) moves the image of a point (x, y, z) by (ex - x/z ez) / (z
// + ez). That is below 2.25 error / z where |x| <= 17/16 z and z >= 64 error. The polygon is
// clipped to |x| and |y| <= 17/16 z and to z >= 64 error: 2 errors are at most 1/32 z.
[[nodiscard]] std::optional<Outline> outline_on(const ParallelView& view, int face,
                                                const Triangle& triangle, double error);
[[nodiscard]] std::optional<Outline> outline_on(const CubeView& view, int face,
                                                const Triangle& triangle, double error);

// The interval of u that the polygon, widened by its margin, covers for v in `v`.
[[nodiscard]] Interval across(const Outline& outline, const Interval& v);

}  // namespace pah
