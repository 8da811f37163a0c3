// Materials, as values. Instances refer to them by MaterialId, an index in Scene::materials.
#pragma once

#include <pah/image/texture.hpp>
#include <string>
#include <variant>

namespace pah {

using MaterialId = std::uint32_t;

struct DiffuseMaterial {
  ColorInput reflectance{Vec3{0.8F}};  // each channel in [0, 1]
};

struct MirrorMaterial {
  ColorInput reflectance{Vec3{1}};
};

// A dielectric boundary; the inside is where the geometric normal points away from.
struct GlassMaterial {
  float ior = 1.5F;          // inside over outside, > 0
  ScalarInput roughness{0};  // perceptual, in [0, 1]; GGX alpha is its square; 0 is smooth
  ColorInput reflectance{Vec3{1}};
  ColorInput transmittance{Vec3{1}};
};

// A conductor under GGX with visible-normal sampling.
struct MetalMaterial {
  Vec3 eta{0.2F};  // per channel, relative to vacuum
  Vec3 k{3};
  ScalarInput roughness{0.1F};
  ColorInput tint{Vec3{1}};  // multiplies the Fresnel reflectance
};

// A smooth or rough dielectric coat over a diffuse base.
struct PlasticMaterial {
  ColorInput reflectance{Vec3{0.5F}};
  float ior = 1.5F;
  ScalarInput roughness{0.2F};
};

// glTF 2.0's metallic-roughness model.
struct PrincipledMaterial {
  ColorInput base_color{Vec3{0.8F}};
  ScalarInput metallic{0};  // in [0, 1]
  ScalarInput roughness{0.5F};
  float ior = 1.5F;
};

using MaterialModel = std::variant<DiffuseMaterial, MirrorMaterial, GlassMaterial, MetalMaterial,
                                   PlasticMaterial, PrincipledMaterial>;

struct Material {
  std::string name;
  MaterialModel model = DiffuseMaterial{};
  TextureId normal_map = no_texture;  // tangent space, linear, (r, g, b) * 2 - 1
  float normal_scale = 1;             // multiplies the map's x and y
  ScalarInput opacity{1};             // the share of light that is stopped, in [0, 1]
  float opacity_cutoff = 0;           // if above 0: opacity is 1 from this value on, else 0
  bool vertex_colors = false;  // multiply a principled base color, or the transmittance of glass
};

}  // namespace pah
