#include "render/surface/surface_interaction.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/normal.hpp"

namespace pah {

namespace {

// How far the curved surface lies above the point with barycentrics b, and below it. Hanika's mean
// height of the tangent planes at the vertices is the sum of b_i b_j dot(v_i - v_j, n_i - n_j) over
// the edges. Divided by 1 + the length of the interpolated normal n it reaches the surface: exactly
// on a unit sphere, where the sum is 1 - |n|^2 and the point is n, and to second order elsewhere.
// Edges that bend up and edges that bend down, on saddles, do not cancel.
Vec2 bulge(const Triangle& v, const Triangle& n, const Vec3& b, float length) {
  const Vec3 edges(b.x * b.y * glm::dot(v.a - v.b, n.a - n.b),
                   b.y * b.z * glm::dot(v.b - v.c, n.b - n.c),
                   b.z * b.x * glm::dot(v.c - v.a, n.c - n.a));
  const Vec3 above = glm::max(edges, 0.0F), below = glm::max(-edges, 0.0F);
  return Vec2(above.x + above.y + above.z, below.x + below.y + below.z) / (1 + length);
}

}  // namespace

Vec2 uv_at(const World& world, std::uint32_t triangle, const Vec2& barycentrics) {
  if (!world.surfaces[world.surface_of_triangle[triangle]].has_uvs) return barycentrics;
  const UVec3& k = world.indices[triangle];
  return (1 - barycentrics.x - barycentrics.y) * world.uvs[k.x] + barycentrics.x * world.uvs[k.y] +
         barycentrics.y * world.uvs[k.z];
}

Vec3 vertex_color_at(const World& world, const Hit& hit) {
  if (!world.surfaces[world.surface_of_triangle[hit.triangle]].has_colors) return Vec3(1);
  const UVec3& k = world.indices[hit.triangle];
  return (1 - hit.u - hit.v) * world.colors[k.x] + hit.u * world.colors[k.y] +
         hit.v * world.colors[k.z];
}

SurfaceInteraction interact(const World& world, const Hit& hit) {
  const UVec3& k = world.indices[hit.triangle];
  const Triangle triangle = world.triangles()[hit.triangle];
  const float b0 = 1 - hit.u - hit.v;

  SurfaceInteraction at;
  at.surface = &world.surfaces[world.surface_of_triangle[hit.triangle]];
  const Vec3 a = b0 * triangle.a, b = hit.u * triangle.b, c = hit.v * triangle.c;
  at.point.position = a + b + c;
  at.point.error = rounding_bound(7) * (glm::abs(a) + glm::abs(b) + glm::abs(c));
  at.point.normal = geometric_normal(triangle);
  at.normal = at.point.normal;

  if (at.surface->has_normals) {
    const Triangle n{world.normals[k.x], world.normals[k.y], world.normals[k.z]};
    const Vec3 sum = b0 * n.a + hit.u * n.b + hit.v * n.c;
    const float length = glm::length(sum);
    if (length > 0) {
      at.normal = sum / length;
      at.curved = n.a != n.b || n.a != n.c;
      if (at.curved) at.bulge = bulge(triangle, n, {b0, hit.u, hit.v}, length);
      if (glm::dot(at.normal, at.point.normal) < 0) {
        at.normal = -at.normal;
        at.bulge = {at.bulge.y, at.bulge.x};
      }
      at.smooth = at.normal != at.point.normal;
    }
  }
  if (at.surface->has_uvs) {
    at.uv = b0 * world.uvs[k.x] + hit.u * world.uvs[k.y] + hit.v * world.uvs[k.z];
    const Vec2 d1 = world.uvs[k.y] - world.uvs[k.x], d2 = world.uvs[k.z] - world.uvs[k.x];
    const float determinant = d1.x * d2.y - d1.y * d2.x;
    const Vec3 e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a;
    const float twice_area = glm::length(glm::cross(e1, e2));
    if (determinant != 0 && twice_area > 0) {
      at.tangent = (d2.y * e1 - d1.y * e2) / determinant;
      at.mirrored = determinant < 0;
      at.uv_per_length = std::sqrt(std::abs(determinant) / twice_area);
    }
  } else {
    at.uv = {hit.u, hit.v};
  }
  return at;
}

Vec3 visible_normal(const Vec3& shading, const Vec3& geometric, const Vec3& wo) {
  const float cosine = glm::dot(shading, wo);
  if (cosine * glm::dot(geometric, wo) >= 0) return shading;
  return shading - 2 * cosine * wo;
}

SurfacePoint lifted_point(const SurfaceInteraction& at, float lift) {
  const Vec3 offset = lift * at.normal;
  SurfacePoint point = at.point;
  point.position += offset;
  // The sum is rounded, as was the product of the normals, whose sign tells up from down.
  point.error +=
      rounding_bound(1) * glm::abs(point.position) + rounding_bound(4) * glm::abs(offset);
  return point;
}

float terminator_fade(const Vec3& shading, const Vec3& surface, const Vec3& wi) {
  const float g = std::abs(glm::dot(surface, wi)) /
                  (std::abs(glm::dot(shading, wi)) * std::abs(glm::dot(surface, shading)));
  if (!(g < 1)) return 1;
  return g * (1 + g * (1 - g));
}

}  // namespace pah
