// Conductors: GGX microfacets under the complex Fresnel equations.
#include "render/bsdf/fresnel.hpp"
#include "render/bsdf/microfacet.hpp"
#include "render/bsdf/models.hpp"

namespace pah::models {

Vec3 evaluate(const MetalBsdf& m, const Vec3& wo, const Vec3& wi) {
  if (m.alpha == 0 || wi.z < 0) return Vec3{0};
  const auto [h, cos_h] = mirroring_facet(wo, wi);
  return m.tint * fresnel_conductor(cos_h, m.eta, m.k) *
         (ggx_d(h, m.alpha) * ggx_visibility(wo, wi, m.alpha));
}

float pdf(const MetalBsdf& m, const Vec3& wo, const Vec3& wi) {
  if (m.alpha == 0 || wi.z < 0) return 0;
  // Reflection about h stretches solid angles by 4 |wo . h|.
  return ggx_visible_density(wo, mirroring_facet(wo, wi).h, m.alpha) / 4;
}

std::optional<BsdfSample> sample(const MetalBsdf& m, const Vec3& wo, float /*u*/, Vec2 u2) {
  if (m.alpha == 0) {
    return BsdfSample{.wi = mirrored(wo),
                      .weight = m.tint * fresnel_conductor(wo.z, m.eta, m.k),
                      .specular = true};
  }
  const Vec3 h = sample_ggx_visible(wo, m.alpha, u2);
  const float cos_h = glm::dot(wo, h);
  const Vec3 wi = glm::normalize(2 * cos_h * h - wo);
  if (!(wi.z > 0)) return std::nullopt;
  return BsdfSample{wi,
                    m.tint * fresnel_conductor(cos_h, m.eta, m.k) * ggx_shadowing(wo, wi, m.alpha),
                    ggx_visible_density(wo, h, m.alpha) / 4};
}

}  // namespace pah::models
