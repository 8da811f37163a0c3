// Sampling a triangle as seen from a point, uniformly in solid angle where that is well
// conditioned and uniformly in area elsewhere.
#pragma once

#include <optional>
#include <pah/geometry/triangles.hpp>

namespace pah {

// The solid angle that a triangle fills, in [0, 2 pi] (Van Oosterom & Strackee 1983).
[[nodiscard]] double solid_angle(const Triangle& triangle, const Vec3& from);

// Whether solid-angle sampling is used for a triangle that fills this solid angle: below, the
// spherical excess cancels and area sampling is as good; above, the triangle is nearly a
// half-space.
[[nodiscard]] bool sampled_by_solid_angle(double omega);

// Barycentric weights (of the second and third vertex) of a point whose direction is uniform in
// solid angle: Arvo, "Stratified Sampling of Spherical Triangles" (SIGGRAPH 1995). `omega`
// is its solid angle. Empty if the triangle is degenerate as seen from there.
[[nodiscard]] std::optional<Vec2> sample_solid_angle(const Triangle& triangle, const Vec3& from,
                                                     double omega, const Vec2& u);

}  // namespace pah
