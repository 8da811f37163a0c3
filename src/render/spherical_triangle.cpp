#include "render/spherical_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/solid_angle.hpp"

namespace pah {
namespace {

// The part of `v` at right angles to the unit vector `w`, of unit length.
DVec3 orthonormal_to(const DVec3& v, const DVec3& w) {
  return glm::normalize(v - glm::dot(v, w) * w);
}

}  // namespace

double solid_angle(const Triangle& triangle, const Vec3& from) {
  const DVec3 a = DVec3(triangle.a) - DVec3(from);
  const DVec3 b = DVec3(triangle.b) - DVec3(from);
  const DVec3 c = DVec3(triangle.c) - DVec3(from);
  return solid_angle(a, b, c, std::abs(glm::dot(a, glm::cross(b, c))));
}

bool sampled_by_solid_angle(double omega) {
  // In double the spherical excess of 1e-4 sr keeps eleven digits; from the largest one on,
  // the triangle's own sides pass within a few degrees of great circles.
  return omega > 1e-4 && omega < 2 * std::numbers::pi - 0.05;
}

std::optional<Vec2> sample_solid_angle(const Triangle& triangle, const Vec3& from, double omega,
                                       const Vec2& u) {
  const DVec3 origin(from);
  const DVec3 a = glm::normalize(DVec3(triangle.a) - origin);
  const DVec3 b = glm::normalize(DVec3(triangle.b) - origin);
  const DVec3 c = glm::normalize(DVec3(triangle.c) - origin);
  // The angle at a, between the planes of its two sides.
  const DVec3 side_b = glm::normalize(glm::cross(a, b)), side_c = glm::normalize(glm::cross(a, c));
  const double cos_alpha = glm::dot(side_b, side_c);
  const double sin_alpha = glm::length(glm::cross(side_b, side_c));

  // The vertex c' for which the triangle a b c' has the share u.x of the area; phi is that area
  // plus pi less alpha.
  const double share = static_cast<double>(u.x) * omega;
  const double cos_share = std::cos(share), sin_share = std::sin(share);
  const double cos_phi = -(cos_share * cos_alpha + sin_share * sin_alpha);
  const double sin_phi = cos_share * sin_alpha - sin_share * cos_alpha;
  const double k1 = cos_phi + cos_alpha;
  const double k2 = sin_phi - sin_alpha * glm::dot(a, b);
  const double cos_ac = std::clamp((k2 + (k2 * cos_phi - k1 * sin_phi) * cos_alpha) /
                                       ((k2 * sin_phi + k1 * cos_phi) * sin_alpha),
                                   -1.0, 1.0);
  const double sin_ac = std::sqrt(std::max(0.0, 1 - cos_ac * cos_ac));
  const DVec3 c_prime = cos_ac * a + sin_ac * orthonormal_to(c, a);

  // A point on the arc from b to c'.
  const double cos_b = 1 - static_cast<double>(u.y) * (1 - glm::dot(c_prime, b));
  const double sin_b = std::sqrt(std::max(0.0, 1 - cos_b * cos_b));
  const DVec3 w = cos_b * b + sin_b * orthonormal_to(c_prime, b);

  // Where the direction meets the triangle's plane.
  const DVec3 e1 = DVec3(triangle.b) - DVec3(triangle.a);
  const DVec3 e2 = DVec3(triangle.c) - DVec3(triangle.a);
  const DVec3 s = origin - DVec3(triangle.a);
  const DVec3 w_e2 = glm::cross(w, e2);
  const double determinant = glm::dot(w_e2, e1);
  double b1 = glm::dot(s, w_e2) / determinant;
  double b2 = glm::dot(w, glm::cross(s, e1)) / determinant;
  if (!std::isfinite(b1) || !std::isfinite(b2)) return std::nullopt;
  b1 = std::clamp(b1, 0.0, 1.0);
  b2 = std::clamp(b2, 0.0, 1.0 - b1);
  return Vec2{static_cast<float>(b1), static_cast<float>(b2)};
}

}  // namespace pah
