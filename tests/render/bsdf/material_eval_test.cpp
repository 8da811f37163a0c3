#include "render/bsdf/material_eval.hpp"

#include <cmath>

#include "catch.hpp"
#include "render/bsdf/microfacet.hpp"
#include "render/surface/shading_frame.hpp"

using namespace pah;

namespace {

// Returns constant textures: checkerboards of one color.
TextureStore constants(std::initializer_list<Vec3> colors) {
  std::vector<Texture> textures;
  for (const Vec3& color : colors) textures.emplace_back(CheckerTexture{color, color, {1, 1}});
  return TextureStore(textures);
}

template <typename Model>
Bsdf resolve(const Model& model, const TextureStore& textures) {
  return resolve_material(Material{.name = "m", .model = model}, textures, {0.3F, 0.3F}, 0);
}

}  // namespace

TEST_CASE("Materials resolve to their BSDFs") {
  const TextureStore textures = constants({{0.5F, 0.25F, 2}, {0.1F, 0.6F, 0.9F}});
  const auto diffuse = std::get<DiffuseBsdf>(resolve(DiffuseMaterial{{Vec3{0.5F}, 0}}, textures));
  CHECK(diffuse.reflectance == Vec3{0.25F, 0.125F, 1});
  // Texture values above 1 are clamped, as they would create light.
  CHECK(albedo(resolve(MirrorMaterial{{Vec3{1}, 0}}, textures)) == Vec3{0.5F, 0.25F, 1});

  const auto metal =
      std::get<MetalBsdf>(resolve(MetalMaterial{Vec3{0.2F}, Vec3{1e30F}, {1, 1, 1}, {}}, textures));
  CHECK(metal.alpha == Approx(0.36));
  CHECK(std::isfinite(metal.k.x * metal.k.x));

  const auto principled = std::get<CoatedBsdf>(
      resolve(PrincipledMaterial{{Vec3{1}, 1}, {1, 1, 2}, {1, 1, 0}, 1.5F}, textures));
  CHECK(principled.metallic == 0.9F);
  CHECK(principled.alpha == Approx(0.01));
  CHECK(principled.albedo == Vec3{0.1F, 0.6F, 0.9F});
  CHECK(std::holds_alternative<CoatedBsdf>(resolve(PlasticMaterial{}, textures)));
}

TEST_CASE("Very small roughness counts as smooth") {
  const TextureStore none = constants({});
  const auto alpha = [&](float roughness, float ior) {
    return std::get<GlassBsdf>(
               resolve(GlassMaterial{ior, {roughness, no_texture, 0}, {}, {}}, none))
        .alpha;
  };
  CHECK(alpha(0, 1.5F) == 0);
  CHECK(alpha(0.02F, 1.5F) == 0);
  CHECK(alpha(0.1F, 1.5F) == Approx(0.01));
  // The closer the indices, the shorter the half vector.
  CHECK(alpha(0.1F, 1.01F) == 0);
  CHECK(alpha(1, 1) == 0);
  CHECK(ggx_alpha(0.02F) == 0);
  CHECK(ggx_alpha(0.03F) > min_ggx_alpha);
}

TEST_CASE("Opacity and normal maps are read") {
  const TextureStore textures =
      constants({{0.5F, 0.5F, 1}, {1, 0.5F, 0.5F}, {0.75F, 0.5F, 0.9330127F}, {0, 0, 0}});
  Material material;
  CHECK(opacity(material, textures, {}, 0) == 1);
  material.opacity = {3, 0, 0};
  CHECK(opacity(material, textures, {}, 0) == 1);
  material.opacity = {0.5F, 0, 1};
  CHECK(opacity(material, textures, {}, 0) == 0.25F);
  material.opacity_cutoff = 0.25F;
  CHECK(opacity(material, textures, {}, 0) == 1);
  material.opacity_cutoff = 0.26F;
  CHECK(opacity(material, textures, {}, 0) == 0);

  CHECK(mapped_normal(material, textures, {}, 0) == Vec3{0, 0, 1});
  material.normal_map = 0;
  CHECK(glm::distance(mapped_normal(material, textures, {}, 0), Vec3{0, 0, 1}) < 1e-6F);
  material.normal_map = 2;
  CHECK(glm::distance(mapped_normal(material, textures, {}, 0), Vec3{0.5F, 0, 0.8660254F}) < 1e-6F);
  material.normal_scale = -3;  // tan 30 degrees becomes -tan 60 degrees
  CHECK(glm::distance(mapped_normal(material, textures, {}, 0), Vec3{-0.8660254F, 0, 0.5F}) <
        1e-6F);
  material.normal_scale = 1;
  // In the surface or under it.
  for (const TextureId flat : {1U, 3U}) {
    material.normal_map = flat;
    CHECK(mapped_normal(material, textures, {}, 0) == Vec3{0, 0, 1});
  }
}

TEST_CASE("Frames are orthonormal and right-handed about any normal") {
  const auto check = [](const ShadingFrame& f) {
    CHECK(glm::length(f.x) == Approx(1).margin(1e-5));
    CHECK(glm::length(f.y) == Approx(1).margin(1e-5));
    CHECK(std::abs(glm::dot(f.x, f.z)) < 1e-5F);
    CHECK(glm::distance(glm::cross(f.z, f.x), f.y) < 1e-5F);
    const Vec3 w = glm::normalize(Vec3{0.3F, -0.2F, 0.8F});
    CHECK(glm::distance(f.world_from_local(f.local_from_world(w)), w) < 1e-5F);
  };
  for (const Vec3& n : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{0, -1, 0},
                        glm::normalize(Vec3{1e-4F, 1e-4F, -1}), glm::normalize(Vec3{1, 2, 3})}) {
    check(make_frame(n));
    for (const Vec3& t : {Vec3{0}, n, Vec3{5, 0, 0}, Vec3{0, 1e-20F, 0}, Vec3{std::nanf("")},
                          Vec3{1e30F, 1, 0}, n + Vec3{1e-6F, 0, 0}}) {
      check(make_frame(n, t));
    }
  }
  const ShadingFrame along = make_frame({0, 0, 1}, {3, 4, 5});
  CHECK(glm::distance(along.x, Vec3{0.6F, 0.8F, 0}) < 1e-6F);
}
