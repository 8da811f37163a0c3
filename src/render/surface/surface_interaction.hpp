// The point where a ray met a surface, with everything that shading needs.
#pragma once

#include <pah/scene/world.hpp>

#include "render/surface/shading_frame.hpp"
#include "render/surface/spawn.hpp"

namespace pah {

struct SurfaceInteraction {
  SurfacePoint point;  // with the geometric normal
  Vec3 normal{0};      // interpolated, on the geometric normal's side
  Vec3 tangent{0};     // along growing u, of any length; zero if not known
  Vec2 uv{0};
  float uv_per_length = 0;  // texture coordinates per unit of length
  bool mirrored = false;    // growing u, growing v and the normal are left-handed
  bool smooth = false;      // the two normals differ
  bool curved = false;      // the vertices' normals differ: the facet stands for a curved surface,
  Vec2 bulge{0};            // that far from it on the normal's side and, as saddles, on the other
  const Surface* surface = nullptr;

  // How far along the normal the curved surface is, seen from `wo`. Zero if it is behind the facet
  // or within the error of `point`. That is 7 roundoffs of the vertices' weighted sum; normals that
  // differ by rounding only make a bulge of at most 4.
  [[nodiscard]] float lift(const Vec3& wo) const {
    const bool behind = glm::dot(wo, point.normal) < 0;
    const float size = behind ? bulge.y : bulge.x;
    if (!(size > point.error.x + point.error.y + point.error.z)) return 0;
    return behind ? -size : size;
  }
};

[[nodiscard]] SurfaceInteraction interact(const World& world, const Hit& hit);

// Texture coordinates alone, for opacity masks.
[[nodiscard]] Vec2 uv_at(const World& world, std::uint32_t triangle, const Vec2& barycentrics);

// The interpolated color of the mesh, which may exceed 1; white if it has no colors.
[[nodiscard]] Vec3 vertex_color_at(const World& world, const Hit& hit);

// A shading normal seen from the same side as the geometry: where `wo` would lie behind it, it is
// mirrored about the plane across `wo`, which is continuous and turns it towards the geometric one.
[[nodiscard]] Vec3 visible_normal(const Vec3& shading, const Vec3& geometric, const Vec3& wo);

// The point on the curved surface, `lift` along the normal, where the facets around do not cut off
// light: Hanika, "Hacking the Shadow Terminator" (Ray Tracing Gems II, chapter 4).
[[nodiscard]] SurfacePoint lifted_point(const SurfaceInteraction& at, float lift);

// Light that reaches a surface by its shading normal, yet grazes or misses the surface itself,
// fades out instead of being cut off: Chiang, Li & Burley, "Taming the Shadow Terminator"
// (SIGGRAPH 2019 talks). In [0, 1]; 1 where the normals agree.
[[nodiscard]] float terminator_fade(const Vec3& shading, const Vec3& surface, const Vec3& wi);

}  // namespace pah
