// The scattering models to which bsdf.hpp dispatches. Neither z is 0, and wo.z > 0 for all but
// glass: opaque surfaces seen from below have been turned over.
#pragma once

#include <optional>

#include "render/bsdf/types.hpp"
#include "render/sampling/warp.hpp"

namespace pah::models {

[[nodiscard]] inline Vec3 mirrored(const Vec3& w) { return {-w.x, -w.y, w.z}; }

[[nodiscard]] inline Vec3 evaluate(const DiffuseBsdf& m, const Vec3& /*wo*/, const Vec3& wi) {
  return m.reflectance * pdf_cosine_hemisphere(wi);
}
[[nodiscard]] inline float pdf(const DiffuseBsdf& /*m*/, const Vec3& /*wo*/, const Vec3& wi) {
  return pdf_cosine_hemisphere(wi);
}
[[nodiscard]] inline std::optional<BsdfSample> sample(const DiffuseBsdf& m, const Vec3& /*wo*/,
                                                      float /*u*/, Vec2 u2) {
  const Vec3 wi = sample_cosine_hemisphere(u2);
  return BsdfSample{wi, m.reflectance, pdf_cosine_hemisphere(wi)};
}

[[nodiscard]] inline Vec3 evaluate(const MirrorBsdf& /*m*/, const Vec3& /*wo*/,
                                   const Vec3& /*wi*/) {
  return Vec3{0};
}
[[nodiscard]] inline float pdf(const MirrorBsdf& /*m*/, const Vec3& /*wo*/, const Vec3& /*wi*/) {
  return 0;
}
[[nodiscard]] inline std::optional<BsdfSample> sample(const MirrorBsdf& m, const Vec3& wo,
                                                      float /*u*/, Vec2 /*u2*/) {
  return BsdfSample{.wi = mirrored(wo), .weight = m.reflectance, .specular = true};
}

[[nodiscard]] Vec3 evaluate(const GlassBsdf& m, const Vec3& wo, const Vec3& wi);
[[nodiscard]] float pdf(const GlassBsdf& m, const Vec3& wo, const Vec3& wi);
[[nodiscard]] std::optional<BsdfSample> sample(const GlassBsdf& m, const Vec3& wo, float u,
                                               Vec2 u2);

[[nodiscard]] Vec3 evaluate(const MetalBsdf& m, const Vec3& wo, const Vec3& wi);
[[nodiscard]] float pdf(const MetalBsdf& m, const Vec3& wo, const Vec3& wi);
[[nodiscard]] std::optional<BsdfSample> sample(const MetalBsdf& m, const Vec3& wo, float u,
                                               Vec2 u2);

[[nodiscard]] Vec3 evaluate(const CoatedBsdf& m, const Vec3& wo, const Vec3& wi);
[[nodiscard]] float pdf(const CoatedBsdf& m, const Vec3& wo, const Vec3& wi);
[[nodiscard]] std::optional<BsdfSample> sample(const CoatedBsdf& m, const Vec3& wo, float u,
                                               Vec2 u2);

// The weight by which colors choose lobes.
[[nodiscard]] inline float mean(const Vec3& color) {
  return (color.x + color.y + color.z) * (1.0F / 3.0F);
}

}  // namespace pah::models
