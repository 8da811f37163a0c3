// Dielectric boundaries: smooth, or GGX microfacets that reflect and refract (Walter et al.,
// "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007).
#include "render/bsdf/fresnel.hpp"
#include "render/bsdf/microfacet.hpp"
#include "render/bsdf/models.hpp"

namespace pah::models {
namespace {

// The light that one facet sends to wo.
struct Split {
  Vec3 reflected;
  Vec3 transmitted;
  float reflection_probability;  // negative if all is absorbed
};

Split split_by(const GlassBsdf& m, float reflectance) {
  Split split{m.reflectance * reflectance, m.transmittance * (1 - reflectance), -1};
  const float r = mean(split.reflected);
  const float t = mean(split.transmitted);
  if (r + t > 0) split.reflection_probability = r / (r + t);
  return split;
}

// The index beyond the boundary over the index on w's side.
float relative_index(const GlassBsdf& m, const Vec3& w) { return w.z > 0 ? m.eta : 1 / m.eta; }

// Half vector per solid angle of wi where light passes (Walter, eq. 17); scale is
// cos_o - eta cos_i, eta being relative to wo's side.
float refraction_jacobian(float eta, float cos_i, float scale) {
  return eta * eta * cos_i / (scale * scale);
}

// The facet by which wi reaches wo. Impossible ones have cos_o <= 0.
struct Facet {
  Vec3 h{0, 0, 1};
  float cos_o = 0, cos_i = 0;  // the angles' absolute cosines to h
  float reflectance = 0;
};

Facet reflecting_facet(const GlassBsdf& m, const Vec3& wo, const Vec3& wi) {
  const auto [h, cos_h] = mirroring_facet(wo, wi);
  return {h, cos_h, cos_h, fresnel_dielectric(cos_h, relative_index(m, wo)).reflectance};
}

// Computed from the outer and the inner direction, whichever of them is wo: towards grazing angles
// the cosines are mostly rounding, and this way both get the same.
Facet refracting_facet(const GlassBsdf& m, const Vec3& wo, const Vec3& wi) {
  const bool outside = wo.z > 0;
  const Vec3& outer = outside ? wo : wi;
  const Vec3& inner = outside ? wi : wo;
  const Vec3 sum = outer + m.eta * inner;
  const float length = glm::length(sum);
  if (!(length > 0)) return {};
  const Vec3 h = sum / std::copysign(length, sum.z);
  const float cos_outer = glm::dot(outer, h);
  const float cos_inner = -glm::dot(inner, h);
  if (!(cos_outer > 0 && cos_inner > 0)) return {};
  return {h, outside ? cos_outer : cos_inner, outside ? cos_inner : cos_outer,
          fresnel_dielectric(cos_outer, cos_inner, m.eta)};
}

}  // namespace

Vec3 evaluate(const GlassBsdf& m, const Vec3& wo, const Vec3& wi) {
  if (m.alpha == 0) return Vec3{0};
  const bool reflected = (wo.z > 0) == (wi.z > 0);
  const Facet facet = reflected ? reflecting_facet(m, wo, wi) : refracting_facet(m, wo, wi);
  if (!(facet.cos_o > 0)) return Vec3{0};
  const Split split = split_by(m, facet.reflectance);
  const float common = ggx_d(facet.h, m.alpha) * ggx_visibility(wo, wi, m.alpha);
  if (reflected) return split.reflected * common;
  // Walter's eq. 21, in which the squared index of wi's side cancels against the radiance's.
  const float scale = facet.cos_o - relative_index(m, wo) * facet.cos_i;
  return split.transmitted * (4 * common * facet.cos_o * facet.cos_i / (scale * scale));
}

float pdf(const GlassBsdf& m, const Vec3& wo, const Vec3& wi) {
  if (m.alpha == 0) return 0;
  const bool reflected = (wo.z > 0) == (wi.z > 0);
  const Facet facet = reflected ? reflecting_facet(m, wo, wi) : refracting_facet(m, wo, wi);
  if (!(facet.cos_o > 0)) return 0;
  const float p = split_by(m, facet.reflectance).reflection_probability;
  if (p < 0) return 0;
  const float density = ggx_visible_density(wo, facet.h, m.alpha);
  if (reflected) return p * density / 4;
  const float eta = relative_index(m, wo);
  return (1 - p) * density * facet.cos_o *
         refraction_jacobian(eta, facet.cos_i, facet.cos_o - eta * facet.cos_i);
}

std::optional<BsdfSample> sample(const GlassBsdf& m, const Vec3& wo, float u, Vec2 u2) {
  const bool smooth = m.alpha == 0;
  const float eta = relative_index(m, wo);
  const Vec3 up{wo.x, wo.y, std::abs(wo.z)};
  const Vec3 h = smooth ? Vec3{0, 0, 1} : sample_ggx_visible(up, m.alpha, u2);
  const float cos_o = glm::dot(up, h);
  if (!(cos_o > 0)) return std::nullopt;
  const auto [reflectance, cos_i] = fresnel_dielectric(cos_o, eta);
  const Split split = split_by(m, reflectance);
  const float p = split.reflection_probability;
  if (p < 0) return std::nullopt;

  BsdfSample drawn;
  drawn.specular = smooth;
  drawn.transmission = u >= p;
  if (drawn.transmission) {
    drawn.wi = glm::normalize((cos_o / eta - cos_i) * h - up / eta);
    if (!(drawn.wi.z < 0)) return std::nullopt;
    drawn.weight = split.transmitted / ((1 - p) * eta * eta);
  } else {
    drawn.wi = smooth ? mirrored(up) : glm::normalize(2 * cos_o * h - up);
    if (!(drawn.wi.z > 0)) return std::nullopt;
    drawn.weight = split.reflected / p;
  }
  if (!smooth) {
    const float density = ggx_visible_density(up, h, m.alpha);
    drawn.pdf = drawn.transmission ? (1 - p) * density * cos_o *
                                         refraction_jacobian(eta, cos_i, cos_o - eta * cos_i)
                                   : p * density / 4;
    drawn.weight *= ggx_shadowing(up, drawn.wi, m.alpha);
  }
  if (wo.z < 0) drawn.wi.z = -drawn.wi.z;
  return drawn;
}

}  // namespace pah::models
