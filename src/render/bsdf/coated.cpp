#include "render/bsdf/coated.hpp"

#include "render/bsdf/fresnel.hpp"
#include "render/bsdf/microfacet.hpp"
#include "render/bsdf/models.hpp"
#include "render/sampling/warp.hpp"

namespace pah {

CoatedBsdf make_plastic(const Vec3& reflectance, float ior, float alpha) {
  // (1 - F_i) / (1 - F_e) = 1 / n^2 normalizes T(wo) T(wi); the series of inner reflections sums to
  // 1 / (1 - R F_i).
  const float outer = average_fresnel_dielectric(ior);
  const float inner = 1 - (1 - outer) / (ior * ior);
  const Vec3 series = reflectance / (1.0F - reflectance * inner);
  return {.base = series / (ior * ior),
          .eta = ior,
          .alpha = alpha,
          .albedo = Vec3{outer} + (1 - outer) * (1 - inner) * series};
}

CoatedBsdf make_principled(const Vec3& base_color, float metallic, float ior, float alpha) {
  const float outer = average_fresnel_dielectric(ior);
  return {.base = base_color * ((1 - metallic) / (1 - outer)),
          .eta = ior,
          .alpha = alpha,
          .metallic = metallic,
          .metal_f0 = base_color,
          .albedo = base_color};
}

namespace models {
namespace {

Vec3 layer_reflectance(const CoatedBsdf& m, float cos_theta) {
  Vec3 f{0};
  if (m.metallic < 1) f += (1 - m.metallic) * fresnel_dielectric(cos_theta, m.eta).reflectance;
  if (m.metallic > 0) f += m.metallic * fresnel_schlick(cos_theta, m.metal_f0);
  return f;
}

float transmittance(const CoatedBsdf& m, float cos_theta) {
  return 1 - fresnel_dielectric(cos_theta, m.eta).reflectance;
}

Vec3 evaluate_base(const CoatedBsdf& m, const Vec3& wo, const Vec3& wi) {
  if (m.base == Vec3{0}) return Vec3{0};
  return m.base * (transmittance(m, wo.z) * transmittance(m, wi.z) * pdf_cosine_hemisphere(wi));
}

// Chooses lobes by their shares of the light under a smooth coat; 1 without a base.
float coat_probability(const CoatedBsdf& m, const Vec3& wo) {
  const float base = mean(m.base);
  if (!(base > 0)) return 1;
  const float coat = mean(layer_reflectance(m, wo.z));
  return coat / (coat + base * transmittance(m, wo.z));
}

}  // namespace

Vec3 evaluate(const CoatedBsdf& m, const Vec3& wo, const Vec3& wi) {
  if (wi.z < 0) return Vec3{0};
  const Vec3 base = evaluate_base(m, wo, wi);
  if (m.alpha == 0) return base;
  const auto [h, cos_h] = mirroring_facet(wo, wi);
  return base + layer_reflectance(m, cos_h) * (ggx_d(h, m.alpha) * ggx_visibility(wo, wi, m.alpha));
}

float pdf(const CoatedBsdf& m, const Vec3& wo, const Vec3& wi) {
  if (wi.z < 0) return 0;
  const float p = coat_probability(m, wo);
  const float base = (1 - p) * pdf_cosine_hemisphere(wi);
  if (m.alpha == 0) return base;
  return base + p * ggx_visible_density(wo, mirroring_facet(wo, wi).h, m.alpha) / 4;
}

std::optional<BsdfSample> sample(const CoatedBsdf& m, const Vec3& wo, float u, Vec2 u2) {
  const float p = coat_probability(m, wo);
  const bool coat = u < p;
  if (coat && m.alpha == 0) {
    return BsdfSample{
        .wi = mirrored(wo), .weight = layer_reflectance(m, wo.z) / p, .specular = true};
  }
  Vec3 wi;
  if (coat) {
    const Vec3 h = sample_ggx_visible(wo, m.alpha, u2);
    wi = glm::normalize(2 * glm::dot(wo, h) * h - wo);
  } else {
    wi = sample_cosine_hemisphere(u2);
  }
  if (!(wi.z > 0)) return std::nullopt;
  const float density = pdf(m, wo, wi);
  if (!(density > 0)) return std::nullopt;
  return BsdfSample{wi, evaluate(m, wo, wi) / density, density};
}

}  // namespace models
}  // namespace pah
