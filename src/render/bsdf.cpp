#include "render/bsdf.hpp"

#include <glm/gtc/constants.hpp>

#include "render/bsdf_models.hpp"
#include "render/fresnel.hpp"
#include "render/warp.hpp"

namespace pah {
namespace models {

Vec3 evaluate(const DiffuseBsdf& m, const Vec3& /*wo*/, const Vec3& wi) {
  return m.reflectance * pdf_cosine_hemisphere(wi);
}

float pdf(const DiffuseBsdf& /*m*/, const Vec3& /*wo*/, const Vec3& wi) {
  return pdf_cosine_hemisphere(wi);
}

std::optional<BsdfSample> sample(const DiffuseBsdf& m, const Vec3& /*wo*/, float /*u*/, Vec2 u2) {
  const Vec3 wi = sample_cosine_hemisphere(u2);
  return BsdfSample{wi, m.reflectance, pdf_cosine_hemisphere(wi)};
}

Vec3 evaluate(const MirrorBsdf& /*m*/, const Vec3& /*wo*/, const Vec3& /*wi*/) { return Vec3{0}; }

float pdf(const MirrorBsdf& /*m*/, const Vec3& /*wo*/, const Vec3& /*wi*/) { return 0; }

std::optional<BsdfSample> sample(const MirrorBsdf& m, const Vec3& wo, float /*u*/, Vec2 /*u2*/) {
  return BsdfSample{.wi = mirrored(wo), .weight = m.reflectance, .specular = true};
}

}  // namespace models

namespace {

// w as the model wants it: opaque surfaces are seen from above.
template <typename Model>
Vec3 turned(const Model& /*m*/, const Vec3& wo, const Vec3& w) {
  return wo.z > 0 ? w : Vec3{w.x, w.y, -w.z};
}
Vec3 turned(const GlassBsdf& /*m*/, const Vec3& /*wo*/, const Vec3& w) { return w; }

struct SmoothLobes {
  bool operator()(const DiffuseBsdf& /*m*/) const { return true; }
  bool operator()(const MirrorBsdf& /*m*/) const { return false; }
  bool operator()(const GlassBsdf& m) const { return m.alpha > 0; }
  bool operator()(const MetalBsdf& m) const { return m.alpha > 0; }
  bool operator()(const CoatedBsdf& m) const { return m.alpha > 0 || m.base != Vec3{0}; }
};

struct Albedo {
  Vec3 operator()(const DiffuseBsdf& m) const { return m.reflectance; }
  Vec3 operator()(const MirrorBsdf& m) const { return m.reflectance; }
  Vec3 operator()(const GlassBsdf& m) const {
    return glm::mix(m.transmittance, m.reflectance, average_fresnel_dielectric(m.eta));
  }
  Vec3 operator()(const MetalBsdf& m) const { return m.tint * fresnel_conductor(1, m.eta, m.k); }
  Vec3 operator()(const CoatedBsdf& m) const { return m.albedo; }
};

}  // namespace

Vec3 evaluate(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
  if (wo.z == 0 || wi.z == 0) return Vec3{0};
  return std::visit(
      [&](const auto& m) { return models::evaluate(m, turned(m, wo, wo), turned(m, wo, wi)); },
      bsdf);
}

float pdf(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
  if (wo.z == 0 || wi.z == 0) return 0;
  return std::visit(
      [&](const auto& m) { return models::pdf(m, turned(m, wo, wo), turned(m, wo, wi)); }, bsdf);
}

std::optional<BsdfSample> sample(const Bsdf& bsdf, const Vec3& wo, float u, Vec2 u2) {
  if (wo.z == 0) return std::nullopt;
  return std::visit(
      [&](const auto& m) {
        std::optional<BsdfSample> drawn = models::sample(m, turned(m, wo, wo), u, u2);
        if (drawn) drawn->wi = turned(m, wo, drawn->wi);
        if (drawn && drawn->wi.z == 0) drawn.reset();
        return drawn;
      },
      bsdf);
}

bool has_smooth_lobes(const Bsdf& bsdf) { return std::visit(SmoothLobes{}, bsdf); }

Vec3 albedo(const Bsdf& bsdf) { return std::visit(Albedo{}, bsdf); }

}  // namespace pah
