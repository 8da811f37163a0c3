#include "render/bsdf/bsdf.hpp"

#include "render/bsdf/fresnel.hpp"

namespace pah {
namespace {

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

Vec3 albedo(const Bsdf& bsdf) { return std::visit(Albedo{}, bsdf); }

}  // namespace pah
