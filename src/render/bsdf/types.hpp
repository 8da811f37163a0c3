// How surfaces scatter light: a closed set of models.
//
// Directions are unit vectors in the local frame whose z is the shading normal, and point away from
// the surface. For glass the normal tells outside (z > 0) from inside; everything else is opaque
// and the same on both sides. Radiance is transported (light flows from wi to wo), so that glass
// scales it by the squared ratio of the indices where it passes. Whether a direction is on the
// right side of the geometry is the caller's to check.
#pragma once

#include <pah/geometry/vec.hpp>
#include <variant>

namespace pah {

struct DiffuseBsdf {
  Vec3 reflectance{0};
};

struct MirrorBsdf {
  Vec3 reflectance{1};
};

// GGX alpha of 0 stands for a smooth boundary, here and below.
struct GlassBsdf {
  float eta = 1.5F;  // inside over outside
  float alpha = 0;
  Vec3 reflectance{1};
  Vec3 transmittance{1};
};

struct MetalBsdf {
  Vec3 eta{0.2F};
  Vec3 k{3};
  float alpha = 0;
  Vec3 tint{1};
};

// A specular layer over a diffuse base, for plastic and the principled model. The layer reflects
// (1 - metallic) F_dielectric + metallic F_Schlick; the base is base T(wi) T(wo) / pi, where T is
// what the dielectric lets through and `base` has been normalized for it (bsdf_coated.hpp).
struct CoatedBsdf {
  Vec3 base{0};
  float eta = 1.5F;
  float alpha = 0;
  float metallic = 0;
  Vec3 metal_f0{1};
  Vec3 albedo{0};  // for the denoiser
};

using Bsdf = std::variant<DiffuseBsdf, MirrorBsdf, GlassBsdf, MetalBsdf, CoatedBsdf>;

struct BsdfSample {
  Vec3 wi{0, 0, 1};
  Vec3 weight{0};             // f |cos wi| / pdf; of a delta lobe, over its probability
  float pdf = 0;              // per solid angle, of all smooth lobes; 0 for a delta lobe
  bool specular = false;      // drawn from a delta lobe
  bool transmission = false;  // wi and wo lie on different sides
};

}  // namespace pah
