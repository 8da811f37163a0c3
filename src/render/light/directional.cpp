#include "render/light/directional.hpp"

#include <cmath>
#include <numbers>

#include "render/sampling/warp.hpp"
#include "render/surface/shading_frame.hpp"

namespace pah {
namespace {

// Below this half-angle (radians) a cone of directions is no wider than some thousand floats.
constexpr double narrowest_sun = 1000 * 0x1p-24;

bool inside_cone(const DirectionalEmitter& sun, const Vec3& direction) {
  const Vec3 chord = direction - sun.axis;
  return glm::dot(chord, chord) <= 2 * sun.one_minus_cos;
}

}  // namespace

DirectionalEmitter prepare(const DirectionalLight& light) {
  DirectionalEmitter emitter{Vec3(-glm::normalize(light.direction)), light.irradiance, 0, Vec3(0)};
  const double half_angle = glm::radians(light.angle) / 2;
  if (half_angle > narrowest_sun) {
    const double sine = std::sin(half_angle), half_sine = std::sin(half_angle / 2);
    emitter.one_minus_cos = static_cast<float>(2 * half_sine * half_sine);
    emitter.radiance = light.irradiance / static_cast<float>(std::numbers::pi * sine * sine);
  }
  return emitter;
}

std::optional<LightSample> sample(const DirectionalEmitter& emitter, const LitPoint& /*at*/,
                                  const LightNumbers& numbers) {
  if (emitter.one_minus_cos == 0) {
    auto made = sample_toward_infinity(emitter.irradiance, emitter.axis, 1);
    if (made) made->delta = true;
    return made;
  }
  const Vec3 local = sample_uniform_cone(numbers.point, emitter.one_minus_cos);
  return sample_toward_infinity(emitter.radiance, make_frame(emitter.axis).world_from_local(local),
                                pdf_uniform_cone(emitter.one_minus_cos));
}

DistantBounds bounds(const DirectionalEmitter& emitter) {
  const float angle = 2 * std::asin(std::sqrt(emitter.one_minus_cos / 2));
  return distant_bounds(emitter.axis, angle, mean_of(emitter.irradiance));
}

bool is_visible_at_infinity(const DirectionalEmitter& emitter) { return emitter.one_minus_cos > 0; }

Vec3 distant_radiance(const DirectionalEmitter& emitter, const Vec3& direction) {
  return inside_cone(emitter, direction) ? emitter.radiance : Vec3(0);
}

float distant_pdf(const DirectionalEmitter& emitter, const LitPoint& /*at*/,
                  const Vec3& direction) {
  return inside_cone(emitter, direction) ? pdf_uniform_cone(emitter.one_minus_cos) : 0;
}

}  // namespace pah
