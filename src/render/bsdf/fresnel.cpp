#include "render/bsdf/fresnel.hpp"

#include <algorithm>
#include <cmath>

namespace pah {
namespace {

float conductor_reflectance(float cos_theta, float eta, float k) {
  const float cos2 = cos_theta * cos_theta;
  const float sin2 = std::max(0.0F, 1 - cos2);
  const float t0 = eta * eta - k * k - sin2;
  const float a2_plus_b2 = std::sqrt(t0 * t0 + 4 * eta * eta * k * k);
  const float a = std::sqrt(std::max(0.0F, 0.5F * (a2_plus_b2 + t0)));
  const float s1 = a2_plus_b2 + cos2;
  const float s2 = 2 * a * cos_theta;
  if (!(s1 + s2 > 0)) return 1;
  const float rs = (s1 - s2) / (s1 + s2);
  const float p1 = cos2 * a2_plus_b2 + sin2 * sin2;
  const float p2 = s2 * sin2;
  if (!(p1 + p2 > 0)) return rs;
  return 0.5F * rs * (1 + (p1 - p2) / (p1 + p2));
}

// Duntley, "The Optical Properties of Diffusing Materials", JOSA 32 (1942), eq. 1; for n > 1.
double average_entering(double n) {
  const double n2 = n * n;
  const double n4 = n2 * n2;
  const double square_sum = n2 + 1;
  const double square_difference = n2 - 1;
  const double fourth_difference = n4 - 1;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * square_difference * square_difference / (square_sum * square_sum * square_sum) *
             std::log((n - 1) / (n + 1)) -
         2 * n2 * n * (n2 + 2 * n - 1) / (square_sum * fourth_difference) +
         8 * n4 * (n4 + 1) / (square_sum * fourth_difference * fourth_difference) * std::log(n);
}

}  // namespace

DielectricBoundary fresnel_dielectric(float cos_theta, float eta) {
  const float cos_i = std::min(cos_theta, 1.0F);
  const float sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  if (!(sin2_t < 1)) return {1, 0};
  const float cos_t = std::sqrt(1 - sin2_t);
  return {fresnel_dielectric(cos_i, cos_t, eta), cos_t};
}

float fresnel_dielectric(float cos_incident, float cos_transmitted, float eta) {
  const float i = cos_incident;
  const float t = cos_transmitted;
  const float parallel = (eta * i - t) / (eta * i + t);
  const float perpendicular = (i - eta * t) / (i + eta * t);
  return 0.5F * (parallel * parallel + perpendicular * perpendicular);
}

Vec3 fresnel_conductor(float cos_theta, const Vec3& eta, const Vec3& k) {
  const float c = std::min(cos_theta, 1.0F);
  return {conductor_reflectance(c, eta.x, k.x), conductor_reflectance(c, eta.y, k.y),
          conductor_reflectance(c, eta.z, k.z)};
}

Vec3 fresnel_schlick(float cos_theta, const Vec3& f0) {
  const float m = 1 - std::min(cos_theta, 1.0F);
  const float m2 = m * m;
  return f0 + (1.0F - f0) * (m2 * m2 * m);
}

float average_fresnel_dielectric(float eta) {
  if (eta < 1) {
    // Light that enters one way leaves the other: n^2 (1 - F_inside) = 1 - F_outside.
    const float n = 1 / eta;
    return 1 - (1 - average_fresnel_dielectric(n)) / (n * n);
  }
  // Towards 1 the last two terms grow as 1 / (n - 1) and cancel: they leave 2^-52 / (n - 1)^2,
  // while the value itself falls below n - 1. The two meet at 2^-17.
  if (!(eta > 1 + 0x1p-17F)) return 0;
  return static_cast<float>(std::clamp(average_entering(eta), 0.0, 1.0));
}

}  // namespace pah
