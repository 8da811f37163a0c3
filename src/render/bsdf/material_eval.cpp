#include "render/bsdf/material_eval.hpp"

#include <algorithm>
#include <cmath>

#include "render/bsdf/coated.hpp"
#include "render/bsdf/fresnel.hpp"
#include "render/bsdf/microfacet.hpp"

namespace pah {
namespace {

struct Resolver {
  const TextureStore& textures;
  Vec2 uv;
  float footprint;
  Vec3 vertex_color{1};

  [[nodiscard]] Vec3 color(const ColorInput& input) const {
    return glm::clamp(textures.color(input, uv, footprint), 0.0F, 1.0F);
  }
  [[nodiscard]] Vec3 vertex_colored(const ColorInput& input) const {
    return glm::clamp(textures.color(input, uv, footprint) * vertex_color, 0.0F, 1.0F);
  }
  [[nodiscard]] float scalar(const ScalarInput& input) const {
    return std::clamp(textures.scalar(input, uv, footprint), 0.0F, 1.0F);
  }
  [[nodiscard]] float alpha(const ScalarInput& roughness) const {
    return ggx_alpha(scalar(roughness));
  }

  Bsdf operator()(const DiffuseMaterial& m) const { return DiffuseBsdf{color(m.reflectance)}; }
  Bsdf operator()(const MirrorMaterial& m) const { return MirrorBsdf{color(m.reflectance)}; }
  Bsdf operator()(const GlassMaterial& m) const {
    return GlassBsdf{m.ior, glass_alpha(scalar(m.roughness), m.ior), color(m.reflectance),
                     vertex_colored(m.transmittance)};
  }
  Bsdf operator()(const MetalMaterial& m) const {
    return MetalBsdf{glm::clamp(m.eta, 0.0F, max_conductor_index),
                     glm::clamp(m.k, 0.0F, max_conductor_index), alpha(m.roughness), color(m.tint)};
  }
  Bsdf operator()(const PlasticMaterial& m) const {
    return make_plastic(color(m.reflectance), m.ior, alpha(m.roughness));
  }
  Bsdf operator()(const PrincipledMaterial& m) const {
    return make_principled(vertex_colored(m.base_color), scalar(m.metallic), m.ior,
                           alpha(m.roughness));
  }

  // The half vector of refraction is that of wo + eta wi, of length |eta - 1| at least, by which
  // its rounding grows against that of reflection.
  static float glass_alpha(float roughness, float eta) {
    const float alpha = ggx_alpha(roughness);
    return alpha * std::min(std::abs(eta - 1), 1.0F) < min_ggx_alpha ? 0.0F : alpha;
  }
};

}  // namespace

Bsdf resolve_material(const Material& material, const TextureStore& textures, Vec2 uv,
                      float footprint, const Vec3& vertex_color) {
  return std::visit(Resolver{textures, uv, footprint, vertex_color}, material.model);
}

float opacity(const Material& material, const TextureStore& textures, Vec2 uv, float footprint) {
  const float stopped = Resolver{textures, uv, footprint}.scalar(material.opacity);
  if (material.opacity_cutoff == 0) return stopped;
  return stopped >= material.opacity_cutoff ? 1.0F : 0.0F;
}

Vec3 mapped_normal(const Material& material, const TextureStore& textures, Vec2 uv,
                   float footprint) {
  if (material.normal_map == no_texture) return {0, 0, 1};
  const Vec3 map =
      2.0F * Vec3{textures.sample(material.normal_map, uv, TextureUse::data, Vec2{footprint})} -
      1.0F;
  const Vec3 n = map * Vec3{material.normal_scale, material.normal_scale, 1};
  // A normal map does not describe the underside: normals that point there, or have no length, are
  // ignored.
  const float length = glm::length(n);
  return n.z > 0 && std::isfinite(length) ? n / length : Vec3{0, 0, 1};
}

}  // namespace pah
