// The share of unpolarized light that a smooth boundary reflects. Cosines are of the angle to the
// normal, in [0, 1].
#pragma once

#include <pah/geometry/vec.hpp>

namespace pah {

struct DielectricBoundary {
  float reflectance = 0;
  float cos_transmitted = 0;  // 0 where all is reflected
};

// eta is the index beyond the boundary over the index before it, > 0.
[[nodiscard]] DielectricBoundary fresnel_dielectric(float cos_theta, float eta);

// The reflectance from both cosines; the same from either side.
[[nodiscard]] float fresnel_dielectric(float cos_incident, float cos_transmitted, float eta);

// Complex index eta + i k, per channel; both >= 0 and at most max_conductor_index.
inline constexpr float max_conductor_index = 1e4F;
[[nodiscard]] Vec3 fresnel_conductor(float cos_theta, const Vec3& eta, const Vec3& k);

// f0 at normal incidence, 1 at grazing incidence (Schlick 1994).
[[nodiscard]] Vec3 fresnel_schlick(float cos_theta, const Vec3& f0);

// The reflectance of a dielectric under diffuse light: the mean over the cosine-weighted
// hemisphere.
[[nodiscard]] float average_fresnel_dielectric(float eta);

}  // namespace pah
