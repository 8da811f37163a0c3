#include "render/light/light_importance.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/light/light_importance.cpp"
#include <hwy/foreach_target.h>
// highway.h must follow foreach_target.h.
#include <hwy/highway.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/surface/spawn.hpp"

HWY_BEFORE_NAMESPACE();
namespace pah {
namespace HWY_NAMESPACE {
namespace {

// Small enough that many can be summed.
constexpr float largest_importance = 1e30F;

// By value and without a branch, so that loops vectorize.
HWY_INLINE float larger(float a, float b) { return a < b ? b : a; }
HWY_INLINE float sine_of(float cosine) { return std::sqrt(larger(0.0F, 1 - cosine * cosine)); }

// The cosine, and below the sine, of max(0, a - b) for angles in [0, pi].
HWY_INLINE float cos_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  const float cosine = cos_a * cos_b + sin_a * sin_b;
  return cos_a > cos_b ? 1 : cosine;
}
HWY_INLINE float sin_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  const float sine = sin_a * cos_b - cos_a * sin_b;
  return cos_a > cos_b ? 0 : sine;
}

// Scalar code that the compiler vectorizes, once for each instruction set: it computes all
// alternatives before choosing.
void importances_kernel(std::span<const float> packed, const LitPoint& at,
                        float* __restrict of_each) {
  const std::size_t count = packed.size() / packed_size;
  const float* numbers = packed.data();
  const float *center_x = numbers, *center_y = numbers + count, *center_z = numbers + 2 * count,
              *radius2 = numbers + 3 * count, *axis_x = numbers + 4 * count,
              *axis_y = numbers + 5 * count, *axis_z = numbers + 6 * count,
              *cos_theta_o = numbers + 7 * count, *sin_theta_o = numbers + 8 * count,
              *cos_theta_e = numbers + 9 * count, *intensity = numbers + 10 * count,
              *two_sided = numbers + 11 * count;
  const Vec3 position = at.position, normal = at.normal;
  const float transmits = at.transmits ? 1 : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = center_x[i] - position.x, y = center_y[i] - position.y,
                z = center_z[i] - position.z;
    const float center2 = x * x + y * y + z * z;
    // Within its own sphere a light's irradiance stops growing.
    const float unbounded = intensity[i] * (1 / larger(center2, radius2[i]));
    const float value = largest_importance < unbounded ? largest_importance : unbounded;

    const float distance = std::sqrt(center2);
    const float wx = x / distance, wy = y / distance, wz = z / distance;
    const float sin2_b = radius2[i] / center2;  // of the cone that the box's sphere fills
    const float sin_b = std::sqrt(sin2_b), cos_b = std::sqrt(1 - sin2_b);

    const float along = -(axis_x[i] * wx + axis_y[i] * wy + axis_z[i] * wz);
    const float either_way = std::abs(along);
    const float cos_w = two_sided[i] > 0 ? either_way : along;
    const float sin_w = sine_of(cos_w);
    const float cos_x = cos_of_difference(sin_w, cos_w, sin_theta_o[i], cos_theta_o[i]);
    const float sin_x = sin_of_difference(sin_w, cos_w, sin_theta_o[i], cos_theta_o[i]);
    const float cos_emission = cos_of_difference(sin_x, cos_x, sin_b, cos_b);

    const float facing = wx * normal.x + wy * normal.y + wz * normal.z;
    const float either_side = std::abs(facing);
    const float cos_i = transmits > 0 ? either_side : facing;
    const float cos_incidence = cos_of_difference(sine_of(cos_i), cos_i, sin_b, cos_b);

    const float outside = value * larger(cos_emission, 0) * larger(cos_incidence, 0);
    const float shone_at = cos_emission + rounding_bound(16) >= cos_theta_e[i] ? outside : 0;
    of_each[i] = center2 <= radius2[i] ? value : shone_at;
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace pah
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pah {

namespace {

HWY_EXPORT(importances_kernel);

constexpr float pi = std::numbers::pi_v<float>;

}  // namespace

void pack(const LightBounds& bounds, std::size_t index, std::span<float> packed) {
  const Vec3 center = bounds.box.center(), half = 0.5F * bounds.box.extent();
  const std::array<float, packed_size> numbers{center.x,
                                               center.y,
                                               center.z,
                                               glm::dot(half, half),
                                               bounds.axis.x,
                                               bounds.axis.y,
                                               bounds.axis.z,
                                               bounds.cos_theta_o,
                                               HWY_NAMESPACE::sine_of(bounds.cos_theta_o),
                                               bounds.cos_theta_e,
                                               bounds.intensity,
                                               bounds.two_sided ? 1.0F : 0.0F};
  const std::size_t count = packed.size() / packed_size;
  for (std::size_t i = 0; i < packed_size; ++i) packed[i * count + index] = numbers[i];
}

void importances(std::span<const float> packed, const LitPoint& at, float* __restrict of_each) {
  HWY_DYNAMIC_DISPATCH(importances_kernel)(packed, at, of_each);
}

float importance(const LightBounds& bounds, const LitPoint& at) {
  std::array<float, packed_size> packed{};
  pack(bounds, 0, packed);
  float result = 0;
  importances(packed, at, &result);
  return result;
}

LightBounds point_bounds(const Vec3& position, const Vec3& axis, double theta_o, double theta_e,
                         float intensity) {
  LightBounds bounds;
  bounds.box.extend(position);
  bounds.axis = axis;
  bounds.cos_theta_o = static_cast<float>(std::cos(theta_o));
  bounds.cos_theta_e = static_cast<float>(std::cos(theta_e));
  bounds.intensity = intensity;
  return bounds;
}

DistantBounds distant_bounds(const Vec3& axis, float angle, float irradiance) {
  return {axis, std::cos(angle), std::sin(angle), irradiance, angle >= pi};
}

float importance(const DistantBounds& bounds, const LitPoint& at) {
  if (bounds.everywhere) return bounds.irradiance;
  float cos_i = glm::dot(bounds.axis, at.normal);
  if (at.transmits) cos_i = std::abs(cos_i);
  const float cosine = HWY_NAMESPACE::cos_of_difference(HWY_NAMESPACE::sine_of(cos_i), cos_i,
                                                        bounds.sin_angle, bounds.cos_angle);
  return std::max(0.0F, cosine) * bounds.irradiance;
}

}  // namespace pah
#endif
