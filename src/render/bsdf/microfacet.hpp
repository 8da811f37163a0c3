// The GGX distribution of microfacets with Smith's height-correlated masking (Walter et al. 2007;
// Heitz, JCGT 3(2), 2014), isotropic. Directions lie above the surface (z > 0) unless said
// otherwise; shadowing terms are written so that nothing divides by a vanishing cosine.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <pah/geometry/vec.hpp>

namespace pah {

// Below this alpha a surface counts as smooth. A direction in float is rounded by about 2^-24 per
// component, its way through the frame and the half vector adds as much thrice, and D's relative
// error is at most 2 / alpha times the sum: 2^-11 keeps it, and with it every weight that balances
// two strategies, to 2^-10.
inline constexpr float min_ggx_alpha = 0x1p-11F;

// alpha = roughness^2, or 0 if that counts as smooth.
[[nodiscard]] inline float ggx_alpha(float roughness) {
  const float alpha = roughness * roughness;
  return alpha < min_ggx_alpha ? 0.0F : alpha;
}

// Normals per area and solid angle.
[[nodiscard]] inline float ggx_d(const Vec3& h, float alpha) {
  const float a2 = alpha * alpha;
  // tan^2 from x and y: 1 - z^2 would have no digits left where a narrow lobe has its mass.
  const float t = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return a2 / (glm::pi<float>() * t * t);
}

// |z| (1 + 2 Lambda(w)), Lambda being Smith's auxiliary function.
[[nodiscard]] inline float ggx_slant(const Vec3& w, float alpha) {
  return std::sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y));
}

// 2 |wo.z| (1 + Lambda(wo) + Lambda(wi)). The quotient comes first: products of cosines underflow.
[[nodiscard]] inline float ggx_mutual_slant(const Vec3& wo, const Vec3& wi, float alpha) {
  return std::abs(wo.z / wi.z) * ggx_slant(wi, alpha) + ggx_slant(wo, alpha);
}

// G2 / (4 |wo.z|), which is G2 / (4 |wo.z| |wi.z|) times |wi.z|. The directions may lie on either
// side.
[[nodiscard]] inline float ggx_visibility(const Vec3& wo, const Vec3& wi, float alpha) {
  return 0.5F / ggx_mutual_slant(wo, wi, alpha);
}

// G2 / G1(wo): what is left of a visible normal's weight.
[[nodiscard]] inline float ggx_shadowing(const Vec3& wo, const Vec3& wi, float alpha) {
  return (std::abs(wo.z) + ggx_slant(wo, alpha)) / ggx_mutual_slant(wo, wi, alpha);
}

// The normal that reflects wi to wo. The cosine of both to it is half the length of their sum:
// the same for either order, and right where the sum is short.
struct MirroringFacet {
  Vec3 h;
  float cos_h;
};
[[nodiscard]] inline MirroringFacet mirroring_facet(const Vec3& wo, const Vec3& wi) {
  const Vec3 sum = wo + wi;
  const float length = glm::length(sum);
  return {sum / length, 0.5F * length};
}

// The density of the normals that wo sees, over |wo . h|: D G1(wo) / wo.z.
[[nodiscard]] inline float ggx_visible_density(const Vec3& wo, const Vec3& h, float alpha) {
  return 2 * ggx_d(h, alpha) / (std::abs(wo.z) + ggx_slant(wo, alpha));
}

// A normal with density ggx_visible_density * |wo . h| (Dupuy and Benyoub, "Sampling Visible GGX
// Normals with Spherical Caps", CGF 42(8), 2023).
[[nodiscard]] inline Vec3 sample_ggx_visible(const Vec3& wo, float alpha, Vec2 u) {
  const Vec3 w = glm::normalize(Vec3{alpha * wo.x, alpha * wo.y, wo.z});
  const float phi = 2 * glm::pi<float>() * u.x;
  // The half vector's height, > 0 since u.y < 1, rather than the cap point's less w.z.
  const float height = (1 - u.y) * (1 + w.z);
  const float z = height - w.z;
  const float sin_theta = std::sqrt(std::max(0.0F, (1 - z) * (1 + z)));
  return glm::normalize(Vec3{alpha * (w.x + sin_theta * std::cos(phi)),
                             alpha * (w.y + sin_theta * std::sin(phi)), height});
}

}  // namespace pah
