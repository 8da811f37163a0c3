#include "render/lights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/normal.hpp"
#include "render/shading_frame.hpp"
#include "render/spawn.hpp"
#include "render/spherical_triangle.hpp"
#include "render/surface_interaction.hpp"
#include "render/warp.hpp"

namespace pah {
namespace {

using std::numbers::pi_v;

// Below this half-angle (radians) a cone of directions is no wider than some thousand floats.
constexpr double narrowest_sun = 1000 * 0x1p-24;

float mean_of(const Vec3& color) { return (color.x + color.y + color.z) / 3; }

bool inside_cone(const DirectionalEmitter& sun, const Vec3& direction) {
  const Vec3 chord = direction - sun.axis;
  return glm::dot(chord, chord) <= 2 * sun.one_minus_cos;
}

Vec3 environment_radiance(const EnvironmentEmitter& emitter, const Vec3& direction) {
  if (!emitter.distribution) return emitter.radiance;
  const Image& image = emitter.image;
  const Vec2 uv = lat_long_from_direction(glm::transpose(emitter.world_from_light) * direction);
  const float x = uv.x * static_cast<float>(image.width) - 0.5F;
  const float y = std::clamp(uv.y * static_cast<float>(image.height) - 0.5F, 0.0F,
                             static_cast<float>(image.height - 1));
  const float x_floor = std::floor(x), y_floor = std::floor(y);
  const int x0 = (static_cast<int>(x_floor) + image.width) % image.width;
  const int x1 = (x0 + 1) % image.width;
  const int y0 = static_cast<int>(y_floor);
  const int y1 = std::min(y0 + 1, image.height - 1);
  const auto texel = [&](int column, int row) {
    return image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                        static_cast<std::size_t>(column)];
  };
  const Vec3 top = glm::mix(texel(x0, y0), texel(x1, y0), x - x_floor);
  const Vec3 bottom = glm::mix(texel(x0, y1), texel(x1, y1), x - x_floor);
  return emitter.radiance * glm::mix(top, bottom, y - y_floor);
}

// A constant environment is drawn by the cosine: uniformly where light from behind counts too.
float pdf_environment(const EnvironmentEmitter& emitter, const LitPoint& at,
                      const Vec3& direction) {
  if (emitter.distribution) {
    return emitter.distribution->pdf(glm::transpose(emitter.world_from_light) * direction);
  }
  if (at.transmits) return pdf_uniform_sphere();
  return std::max(0.0F, glm::dot(direction, at.normal)) / pi_v<float>;
}

// How far off a triangle's plane a segment may meet it that ends on it, seen from a point at a
// distance: the point's own error, and that of the corners, which the ray-triangle test shears into
// the ray's frame, 5 roundings each of coordinates of up to twice their distance, two products and
// a sum for the edges of the two axes across.
float end_error(const Triangle& triangle, const SurfacePoint& point, const Vec3& from) {
  const float farthest = std::max({glm::distance(triangle.a, from), glm::distance(triangle.b, from),
                                   glm::distance(triangle.c, from)});
  return glm::dot(glm::abs(point.normal), point.error) + rounding_bound(2 * 2 * (5 + 3)) * farthest;
}

// Samples are made where they are returned: what is copied right after it was written is waited
// for.
std::optional<LightSample> toward_point(const Vec3& position, const Vec3& from,
                                        const Vec3& intensity) {
  const Vec3 to_light = position - from;
  const float distance2 = glm::dot(to_light, to_light);
  std::optional<LightSample> made(std::in_place);
  if (!(distance2 > 0)) {
    made.reset();
    return made;
  }
  LightSample& sample = *made;
  sample.radiance = intensity / distance2;
  sample.direction = to_light / std::sqrt(distance2);
  sample.pdf = 1;
  sample.delta = true;
  sample.target = position;
  sample.target_error = rounding_bound(7) * glm::length(position);
  return made;
}

std::optional<LightSample> toward_infinity(const Vec3& radiance, const Vec3& direction, float pdf) {
  std::optional<LightSample> made(std::in_place);
  LightSample& sample = *made;
  sample.radiance = radiance;
  sample.direction = direction;
  sample.pdf = pdf;
  sample.distant = true;
  return made;
}

std::optional<LightSample> sample_light(const PointEmitter& emitter, const LitPoint& at) {
  return toward_point(emitter.position, at.position, emitter.intensity);
}

std::optional<LightSample> sample_light(const SpotEmitter& emitter, const LitPoint& at) {
  auto made = toward_point(emitter.position, at.position, emitter.intensity);
  if (!made) return made;
  const float cosine = -glm::dot(made->direction, emitter.axis);
  if (cosine < emitter.cos_outer) {
    made.reset();
  } else if (cosine < emitter.cos_inner) {
    made->radiance *= glm::smoothstep(emitter.cos_outer, emitter.cos_inner, cosine);
  }
  return made;
}

std::optional<LightSample> sample_light(const DirectionalEmitter& emitter, const Vec2& u2) {
  if (emitter.one_minus_cos == 0) {
    auto made = toward_infinity(emitter.irradiance, emitter.axis, 1);
    if (made) made->delta = true;
    return made;
  }
  const Vec3 local = sample_uniform_cone(u2, emitter.one_minus_cos);
  return toward_infinity(emitter.radiance, make_frame(emitter.axis).world_from_local(local),
                         pdf_uniform_cone(emitter.one_minus_cos));
}

std::optional<LightSample> sample_light(const EnvironmentEmitter& emitter, const LitPoint& at,
                                        const Vec2& u2) {
  Vec3 direction;
  float pdf = 0;
  if (emitter.distribution) {
    const auto drawn = emitter.distribution->sample(u2);
    direction = emitter.world_from_light * drawn.direction;
    pdf = drawn.pdf;
  } else {
    direction = at.transmits ? sample_uniform_sphere(u2)
                             : make_frame(at.normal).world_from_local(sample_cosine_hemisphere(u2));
    pdf = pdf_environment(emitter, at, direction);
  }
  if (!(pdf > 0)) return std::nullopt;
  return toward_infinity(environment_radiance(emitter, direction), direction, pdf);
}

// What becomes of the lights of a scene, one overload a kind.

Emitter prepare(const PointLight& light, const TextureStore& /*textures*/) {
  return PointEmitter{Vec3(light.position), light.intensity};
}

Emitter prepare(const SpotLight& light, const TextureStore& /*textures*/) {
  const double angle = glm::radians(light.angle);
  return SpotEmitter{Vec3(light.position), Vec3(glm::normalize(light.direction)), light.intensity,
                     static_cast<float>(std::cos(angle * (1 - light.blend))),
                     static_cast<float>(std::cos(angle))};
}

Emitter prepare(const DirectionalLight& light, const TextureStore& /*textures*/) {
  DirectionalEmitter emitter{Vec3(-glm::normalize(light.direction)), light.irradiance, 0, Vec3(0)};
  const double half_angle = glm::radians(light.angle) / 2;
  if (half_angle > narrowest_sun) {
    const double sine = std::sin(half_angle), half_sine = std::sin(half_angle / 2);
    emitter.one_minus_cos = static_cast<float>(2 * half_sine * half_sine);
    emitter.radiance = light.irradiance / static_cast<float>(std::numbers::pi * sine * sine);
  }
  return emitter;
}

// Of all texels, whichever of them the surfaces show.
Vec3 mean_color(const Image& image) {
  DVec3 sum(0);
  for (const Vec3& pixel : image.pixels) sum += pixel;
  return Vec3(sum / static_cast<double>(image.pixels.size()));
}

Emitter prepare(const AreaLight& light, const TextureStore& textures) {
  AreaEmitter emitter;
  emitter.radiance = {light.radiance, light.image};
  const Vec3 mean = light.image == no_texture ? Vec3(1) : mean_color(textures.image(light.image));
  emitter.mean_radiance = mean_of(light.radiance * mean);
  emitter.two_sided = light.two_sided;
  return emitter;
}

Emitter prepare(const EnvironmentLight& light, const TextureStore& textures) {
  EnvironmentEmitter emitter;
  emitter.radiance = light.radiance;
  emitter.world_from_light = glm::mat3(light.world_from_light);
  if (light.image == no_texture) return emitter;
  emitter.image = textures.image(light.image);
  std::vector<float> brightness;
  brightness.reserve(emitter.image.pixels.size());
  for (Vec3& pixel : emitter.image.pixels) {
    pixel = glm::max(pixel, Vec3(0));
    brightness.push_back(mean_of(emitter.radiance * pixel));
  }
  emitter.distribution.emplace(brightness, emitter.image.width, emitter.image.height);
  return emitter;
}

void gather_triangles(const World& world, std::vector<Emitter>& emitters) {
  for (const Surface& surface : world.surfaces) {
    if (surface.light == no_light) continue;
    auto& emitter = std::get<AreaEmitter>(emitters[surface.light]);
    for (std::uint32_t i = 0; i < surface.triangle_count; ++i) {
      const std::uint32_t index = surface.first_triangle + i;
      const Triangle triangle = world.triangles()[index];
      emitter.triangles.push_back({triangle, geometric_normal(triangle), index, area(triangle)});
    }
  }
  for (Emitter& any : emitters) {
    auto* emitter = std::get_if<AreaEmitter>(&any);
    if (emitter == nullptr) continue;
    std::vector<double> areas;
    areas.reserve(emitter->triangles.size());
    for (const EmittingTriangle& triangle : emitter->triangles) {
      areas.push_back(triangle.area);
      emitter->area += triangle.area;
    }
    if (emitter->area > 0) emitter->by_area = AliasTable(areas);
  }
}

LightBounds bounds_of(const AreaEmitter& emitter) {
  LightBounds bounds;
  DVec3 sum(0);
  for (const EmittingTriangle& triangle : emitter.triangles) {
    bounds.box.extend(triangle.corners.bounds());
    sum += scaled_normal(triangle.corners);
  }
  const double length = glm::length(sum);
  if (length > 0) {
    bounds.axis = Vec3(sum / length);
    for (const EmittingTriangle& triangle : emitter.triangles) {
      if (triangle.normal != Vec3(0)) {
        bounds.cos_theta_o = std::min(bounds.cos_theta_o, glm::dot(bounds.axis, triangle.normal));
      }
    }
  } else {
    bounds.cos_theta_o = -1;
  }
  bounds.cos_theta_e = 0;
  bounds.two_sided = emitter.two_sided;
  bounds.intensity = emitter.mean_radiance * static_cast<float>(emitter.area);
  return bounds;
}

LightBounds bounds_at(const Vec3& position, const Vec3& axis, double theta_o, double theta_e,
                      const Vec3& intensity) {
  LightBounds bounds;
  bounds.box.extend(position);
  bounds.axis = axis;
  bounds.cos_theta_o = static_cast<float>(std::cos(theta_o));
  bounds.cos_theta_e = static_cast<float>(std::cos(theta_e));
  bounds.intensity = mean_of(intensity);
  return bounds;
}

LightSampler make_sampler(const std::vector<Emitter>& emitters) {
  std::vector<LightSampler::Placed> placed;
  std::vector<LightSampler::Distant> distant;
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const auto id = static_cast<LightId>(i);
    const auto place = [&](const LightBounds& bounds) {
      if (bounds.intensity > 0) placed.push_back({id, bounds});
    };
    if (const auto* point = std::get_if<PointEmitter>(&emitters[i])) {
      place(bounds_at(point->position, Vec3(0, 0, 1), std::numbers::pi, std::numbers::pi / 2,
                      point->intensity));
    } else if (const auto* spot = std::get_if<SpotEmitter>(&emitters[i])) {
      const double inner = std::acos(static_cast<double>(spot->cos_inner));
      const double outer = std::acos(static_cast<double>(spot->cos_outer));
      place(bounds_at(spot->position, spot->axis, inner, outer - inner, spot->intensity));
    } else if (const auto* emitter = std::get_if<AreaEmitter>(&emitters[i])) {
      if (emitter->area > 0) place(bounds_of(*emitter));
    } else if (const auto* sun = std::get_if<DirectionalEmitter>(&emitters[i])) {
      const float angle = 2 * std::asin(std::sqrt(sun->one_minus_cos / 2));
      const float irradiance = mean_of(sun->irradiance);
      if (irradiance > 0) distant.push_back({id, distant_bounds(sun->axis, angle, irradiance)});
    } else if (const auto* sky = std::get_if<EnvironmentEmitter>(&emitters[i])) {
      const float mean = sky->distribution ? static_cast<float>(sky->distribution->mean())
                                           : mean_of(sky->radiance);
      if (mean > 0)
        distant.push_back({id, distant_bounds(Vec3(0, 1, 0), pi_v<float>, pi_v<float> * mean)});
    }
  }
  return {std::move(placed), std::move(distant), emitters.size()};
}

}  // namespace

Vec3 geometric_normal(const Triangle& triangle) {
  const DVec3 exact = scaled_normal(triangle);
  const Vec3 normal(exact);
  const float length2 = glm::dot(normal, normal);
  // Where float squares neither overflow nor lose digits.
  if (length2 > 0x1p-80F && length2 < 0x1p80F) return normal / std::sqrt(length2);
  const double length = glm::length(exact);
  return length > 0 ? Vec3(exact / length) : Vec3(0);
}

double area(const Triangle& triangle) { return 0.5 * glm::length(scaled_normal(triangle)); }

Lights::Lights(const World& world, const TextureStore& textures)
    : world_(world), textures_(textures) {
  emitters_.reserve(world.lights.size());
  for (const Light& light : world.lights) {
    emitters_.push_back(
        std::visit([&](const auto& model) { return prepare(model, textures); }, light.model));
  }
  gather_triangles(world, emitters_);
  for (std::size_t i = 0; i < emitters_.size(); ++i) {
    const auto* sun = std::get_if<DirectionalEmitter>(&emitters_[i]);
    const auto* emitter = std::get_if<AreaEmitter>(&emitters_[i]);
    if (std::holds_alternative<EnvironmentEmitter>(emitters_[i]) ||
        (sun != nullptr && sun->one_minus_cos > 0)) {
      visible_distant_.push_back(static_cast<LightId>(i));
    }
    any_visible_ = any_visible_ || (emitter != nullptr && emitter->area > 0);
  }
  any_visible_ = any_visible_ || !visible_distant_.empty();
  sampler_ = make_sampler(emitters_);
}

std::optional<LightSample> Lights::sample_area(const AreaEmitter& emitter, const LitPoint& at,
                                               float u, const Vec2& u2) const {
  const EmittingTriangle& from = emitter.triangles[emitter.by_area.sample(u)];
  const Triangle& triangle = from.corners;
  const SphericalTriangle seen(triangle, at.position);
  const bool by_solid_angle = seen.sampled_by_solid_angle();
  const Vec2 b = by_solid_angle ? seen.sample(u2) : sample_uniform_triangle(u2);
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
    sample.radiance = textures_.color(emitter.radiance, uv_at(world_, from.index, b));
  sample.pdf = by_solid_angle
                   ? static_cast<float>(from.area / (emitter.area * seen.solid_angle()))
                   : static_cast<float>(static_cast<double>(distance2) /
                                        (static_cast<double>(std::abs(cosine)) * emitter.area));
  sample.target = offset_point(point, -to_light);
  sample.target_error = end_error(triangle, point, at.position) / std::abs(cosine);
  sample.triangle = from.index;
  sample.barycentrics = b;
  return made;
}

std::optional<LightSample> Lights::sample(LightId light, const LitPoint& at, float u,
                                          const Vec2& u2) const {
  const Emitter& any = emitters_[light];
  if (const auto* area_light = std::get_if<AreaEmitter>(&any)) {
    return sample_area(*area_light, at, u, u2);
  }
  if (const auto* point = std::get_if<PointEmitter>(&any)) return sample_light(*point, at);
  if (const auto* spot = std::get_if<SpotEmitter>(&any)) return sample_light(*spot, at);
  if (const auto* sun = std::get_if<DirectionalEmitter>(&any)) return sample_light(*sun, u2);
  return sample_light(std::get<EnvironmentEmitter>(any), at, u2);
}

Vec3 Lights::emitted(LightId light, const Vec3& normal, const Vec3& direction,
                     const Vec2& uv) const {
  const auto& emitter = std::get<AreaEmitter>(emitters_[light]);
  const bool shines = emitter.two_sided || glm::dot(normal, direction) > 0;
  return shines ? textures_.color(emitter.radiance, uv) : Vec3(0);
}

float Lights::pdf_area(LightId light, const LitPoint& at, std::uint32_t triangle,
                       const Vec3& position, const Vec3& normal) const {
  const auto& emitter = std::get<AreaEmitter>(emitters_[light]);
  const Triangle corners = world_.triangles()[triangle];
  const SphericalTriangle seen(corners, at.position);
  if (seen.sampled_by_solid_angle()) {
    return static_cast<float>(area(corners) / (emitter.area * seen.solid_angle()));
  }
  const Vec3 to_light = position - at.position;
  const float distance2 = glm::dot(to_light, to_light);
  const float cosine = std::abs(glm::dot(to_light, normal)) / std::sqrt(distance2);
  return static_cast<float>(static_cast<double>(distance2) /
                            (static_cast<double>(cosine) * emitter.area));
}

Vec3 Lights::distant_radiance(LightId light, const Vec3& direction) const {
  if (const auto* sky = std::get_if<EnvironmentEmitter>(&emitters_[light])) {
    return environment_radiance(*sky, direction);
  }
  const auto& sun = std::get<DirectionalEmitter>(emitters_[light]);
  return inside_cone(sun, direction) ? sun.radiance : Vec3(0);
}

float Lights::pdf_distant(LightId light, const LitPoint& at, const Vec3& direction) const {
  if (const auto* sky = std::get_if<EnvironmentEmitter>(&emitters_[light])) {
    return pdf_environment(*sky, at, direction);
  }
  const auto& sun = std::get<DirectionalEmitter>(emitters_[light]);
  return inside_cone(sun, direction) ? pdf_uniform_cone(sun.one_minus_cos) : 0;
}

}  // namespace pah
