#include "render/light/area.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/normal.hpp"
#include "render/sampling/spherical_triangle.hpp"
#include "render/sampling/warp.hpp"
#include "render/surface/spawn.hpp"
#include "render/surface/surface_interaction.hpp"

namespace pah {
namespace {

// Returns the mean of all texels, including those that no surface shows.
Vec3 mean_color(const Image& image) {
  DVec3 sum(0);
  for (const Vec3& pixel : image.pixels) sum += pixel;
  return Vec3(sum / static_cast<double>(image.pixels.size()));
}

// How far from a triangle's plane the ray-triangle test may find a segment's hit when the segment
// ends on the triangle. The bound adds the error of the end point to that of the corners. The test
// shears the corners into the ray's frame: 5 roundings each of coordinates of up to twice their
// distance, then two products and a sum for the edges along the two other axes.
float end_error(const Triangle& triangle, const SurfacePoint& point, const Vec3& from) {
  const float farthest = std::max({glm::distance(triangle.a, from), glm::distance(triangle.b, from),
                                   glm::distance(triangle.c, from)});
  return glm::dot(glm::abs(point.normal), point.error) + rounding_bound(2 * 2 * (5 + 3)) * farthest;
}

}  // namespace

AreaEmitter prepare(const AreaLight& light, const World& world, const TextureStore& textures) {
  AreaEmitter emitter;
  emitter.world = &world;
  emitter.textures = &textures;
  emitter.radiance = {light.radiance, light.image};
  const Vec3 mean = light.image == no_texture ? Vec3(1) : mean_color(textures.image(light.image));
  emitter.mean_radiance = mean_of(light.radiance * mean);
  emitter.two_sided = light.two_sided;
  return emitter;
}

void add_surface(AreaEmitter& emitter, const Surface& surface) {
  for (std::uint32_t i = 0; i < surface.triangle_count; ++i) {
    const std::uint32_t index = surface.first_triangle + i;
    const Triangle triangle = emitter.world->triangles()[index];
    emitter.triangles.push_back(
        {triangle, geometric_normal(triangle), index, surface_area(triangle)});
  }
}

void finish(AreaEmitter& emitter) {
  std::vector<double> areas;
  areas.reserve(emitter.triangles.size());
  for (const EmittingTriangle& triangle : emitter.triangles) {
    areas.push_back(triangle.surface_area);
    emitter.surface_area += triangle.surface_area;
  }
  if (emitter.surface_area > 0) emitter.by_surface_area = AliasTable(areas);
}

std::optional<LightSample> sample(const AreaEmitter& emitter, const LitPoint& at,
                                  const LightNumbers& numbers) {
  const EmittingTriangle& from = emitter.triangles[emitter.by_surface_area.sample(numbers.choice)];
  const Triangle& triangle = from.corners;
  const SphericalTriangle seen(triangle, at.position);
  const bool by_solid_angle = seen.sampled_by_solid_angle();
  const Vec2 b =
      by_solid_angle ? seen.sample(numbers.point) : sample_uniform_triangle(numbers.point);
  const float b0 = 1 - b.x - b.y;
  const Vec3 p = b0 * triangle.a, q = b.x * triangle.b, r = b.y * triangle.c;
  SurfacePoint point;
  point.position = p + q + r;
  point.error = rounding_bound(7) * (glm::abs(p) + glm::abs(q) + glm::abs(r));
  point.normal = from.normal;

  const Vec3 to_light = point.position - at.position;
  const float distance2 = glm::dot(to_light, to_light);
  const Vec3 direction = to_light / std::sqrt(distance2);
  const float cosine = -glm::dot(direction, point.normal);
  std::optional<LightSample> made(std::in_place);
  if (!(distance2 > 0) || cosine == 0 || (cosine < 0 && !emitter.two_sided)) {
    made.reset();
    return made;
  }
  LightSample& sample = *made;
  sample.direction = direction;
  sample.radiance = emitter.radiance.value;
  if (emitter.radiance.texture != no_texture)
    sample.radiance =
        emitter.textures->color(emitter.radiance, uv_at(*emitter.world, from.index, b));
  sample.pdf =
      by_solid_angle
          ? static_cast<float>(from.surface_area / (emitter.surface_area * seen.solid_angle()))
          : static_cast<float>(static_cast<double>(distance2) /
                               (static_cast<double>(std::abs(cosine)) * emitter.surface_area));
  sample.target = offset_point(point, -to_light);
  sample.target_error = end_error(triangle, point, at.position) / std::abs(cosine);
  sample.triangle = from.index;
  sample.barycentrics = b;
  return made;
}

LightBounds bounds(const AreaEmitter& emitter) {
  LightBounds result;
  DVec3 sum(0);
  for (const EmittingTriangle& triangle : emitter.triangles) {
    result.box.extend(triangle.corners.bounds());
    sum += scaled_normal(triangle.corners);
  }
  const double length = glm::length(sum);
  if (length > 0) {
    result.axis = Vec3(sum / length);
    for (const EmittingTriangle& triangle : emitter.triangles) {
      if (triangle.normal != Vec3(0)) {
        result.cos_theta_o = std::min(result.cos_theta_o, glm::dot(result.axis, triangle.normal));
      }
    }
  } else {
    result.cos_theta_o = -1;
  }
  result.cos_theta_e = 0;
  result.two_sided = emitter.two_sided;
  result.intensity = emitter.mean_radiance * static_cast<float>(emitter.surface_area);
  return result;
}

Vec3 emitted(const AreaEmitter& emitter, const Vec3& normal, const Vec3& direction,
             const Vec2& uv) {
  const bool shines = emitter.two_sided || glm::dot(normal, direction) > 0;
  return shines ? emitter.textures->color(emitter.radiance, uv) : Vec3(0);
}

float pdf(const AreaEmitter& emitter, const LitPoint& at, std::uint32_t triangle,
          const Vec3& position, const Vec3& normal) {
  const Triangle corners = emitter.world->triangles()[triangle];
  const SphericalTriangle seen(corners, at.position);
  if (seen.sampled_by_solid_angle()) {
    return static_cast<float>(surface_area(corners) / (emitter.surface_area * seen.solid_angle()));
  }
  const Vec3 to_light = position - at.position;
  const float distance2 = glm::dot(to_light, to_light);
  const float cosine = std::abs(glm::dot(to_light, normal)) / std::sqrt(distance2);
  return static_cast<float>(static_cast<double>(distance2) /
                            (static_cast<double>(cosine) * emitter.surface_area));
}

}  // namespace pah
