#include "render/surface_interaction.hpp"

#include <algorithm>
#include <cmath>

#include "render/lights.hpp"

namespace pah {

namespace {

// How far the tangent planes at the vertices, each by its weight, lie above the point and below it
// (Hanika, eq. 4.1 ff.), over 1 + the length of the interpolated normal. On a sphere of radius 1
// that normal is the point p itself and the planes' height 1 - |p|^2, so this is 1 - |p|: the
// sphere is met. Other surfaces are met to second order, and saddles exceeded, as the sides do not
// cancel.
Vec2 bulge(const Vec3& weighted_heights, float length) {
  const Vec3 above = glm::max(weighted_heights, 0.0F), below = glm::max(-weighted_heights, 0.0F);
  return Vec2(above.x + above.y + above.z, below.x + below.y + below.z) / (1 + length);
}

}  // namespace

Vec2 uv_at(const World& world, std::uint32_t triangle, const Vec2& barycentrics) {
  if (!world.surfaces[world.surface_of_triangle[triangle]].has_uvs) return barycentrics;
  const UVec3& k = world.indices[triangle];
  return (1 - barycentrics.x - barycentrics.y) * world.uvs[k.x] + barycentrics.x * world.uvs[k.y] +
         barycentrics.y * world.uvs[k.z];
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
    const Vec3 &na = world.normals[k.x], &nb = world.normals[k.y], &nc = world.normals[k.z];
    const Vec3 sum = b0 * na + hit.u * nb + hit.v * nc;
    const float length = glm::length(sum);
    if (length > 0) {
      at.normal = sum / length;
      at.curved = na != nb || na != nc;
      if (at.curved) {
        const Vec3& p = at.point.position;
        const Vec3 heights(glm::dot(triangle.a - p, na), glm::dot(triangle.b - p, nb),
                           glm::dot(triangle.c - p, nc));
        at.bulge = bulge(Vec3(b0, hit.u, hit.v) * heights, length);
      }
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

SurfacePoint curved_point(const SurfaceInteraction& at, const Vec3& wo) {
  const bool behind = glm::dot(wo, at.point.normal) < 0;
  const Vec3 lift = (behind ? -at.bulge.y : at.bulge.x) * at.normal;
  SurfacePoint point = at.point;
  point.position += lift;
  // It must not end up on the other side: the sum is rounded, and so was the sign of the product of
  // the normals.
  point.error += rounding_bound(1) * glm::abs(point.position) + rounding_bound(4) * glm::abs(lift);
  return point;
}

float terminator_fade(const Vec3& shading, const Vec3& surface, const Vec3& wi) {
  const float g = std::abs(glm::dot(surface, wi)) /
                  (std::abs(glm::dot(shading, wi)) * std::abs(glm::dot(surface, shading)));
  if (!(g < 1)) return 1;
  return g * (1 + g * (1 - g));
}

}  // namespace pah
