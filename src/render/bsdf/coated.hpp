// Makes coats over diffuse bases: plastic and the glTF model.
#pragma once

#include "render/bsdf/bsdf.hpp"

namespace pah {

// A dielectric over a diffuse base, with all inner reflections: the base reflects R, and the
// boundary reflects F_i of that from within.
[[nodiscard]] CoatedBsdf make_plastic(const Vec3& reflectance, float ior, float alpha);

// glTF 2.0's metallic-roughness model (specification, appendix B). Where the specification mixes
// coat and base by the Fresnel term of the half vector, which returns up to twice the light at
// grazing angles, both are coupled by what passes the coat (Shirley et al. 1997): reciprocal too,
// and never above 1. `base_color` is the diffuse albedo, as in the specification.
[[nodiscard]] CoatedBsdf make_principled(const Vec3& base_color, float metallic, float ior,
                                         float alpha);

}  // namespace pah
