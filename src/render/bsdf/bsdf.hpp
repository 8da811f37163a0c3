// Evaluates and samples BSDFs: free functions over a closed set of models (types.hpp). They are
// inline, so that the simplest and most frequent model has no overhead.
#pragma once

#include "render/bsdf/models.hpp"

namespace pah {

namespace models {

// Turns w over for opaque models, which are always seen from above.
template <typename Model>
[[nodiscard]] inline Vec3 turned(const Model& /*m*/, const Vec3& wo, const Vec3& w) {
  return wo.z > 0 ? w : Vec3{w.x, w.y, -w.z};
}
[[nodiscard]] inline Vec3 turned(const GlassBsdf& /*m*/, const Vec3& /*wo*/, const Vec3& w) {
  return w;
}

}  // namespace models

// f |cos wi|; delta lobes are zero.
[[nodiscard]] inline Vec3 evaluate(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
  if (wo.z == 0 || wi.z == 0) return Vec3{0};
  return std::visit(
      [&](const auto& m) {
        return models::evaluate(m, models::turned(m, wo, wo), models::turned(m, wo, wi));
      },
      bsdf);
}

// The density per solid angle with which `sample` draws wi; delta lobes are zero, so it may
// integrate to less than 1.
[[nodiscard]] inline float pdf(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
  if (wo.z == 0 || wi.z == 0) return 0;
  return std::visit(
      [&](const auto& m) {
        return models::pdf(m, models::turned(m, wo, wo), models::turned(m, wo, wi));
      },
      bsdf);
}

// u chooses the lobe, u2 the direction. Returns nothing if all light is absorbed or the drawn
// direction lies below the surface.
[[nodiscard]] inline std::optional<BsdfSample> sample(const Bsdf& bsdf, const Vec3& wo, float u,
                                                      Vec2 u2) {
  if (wo.z == 0) return std::nullopt;
  return std::visit(
      [&](const auto& m) {
        std::optional<BsdfSample> drawn = models::sample(m, models::turned(m, wo, wo), u, u2);
        if (drawn) drawn->wi = models::turned(m, wo, drawn->wi);
        if (drawn && drawn->wi.z == 0) drawn.reset();
        return drawn;
      },
      bsdf);
}

// Returns false if all lobes are delta lobes: next-event estimation is then useless.
[[nodiscard]] inline bool has_smooth_lobes(const Bsdf& bsdf) {
  struct SmoothLobes {
    bool operator()(const DiffuseBsdf& /*m*/) const { return true; }
    bool operator()(const MirrorBsdf& /*m*/) const { return false; }
    bool operator()(const GlassBsdf& m) const { return m.alpha > 0; }
    bool operator()(const MetalBsdf& m) const { return m.alpha > 0; }
    bool operator()(const CoatedBsdf& m) const { return m.alpha > 0 || m.base != Vec3{0}; }
  };
  return std::visit(SmoothLobes{}, bsdf);
}

// An approximate color, for denoising.
[[nodiscard]] Vec3 albedo(const Bsdf& bsdf);

}  // namespace pah
