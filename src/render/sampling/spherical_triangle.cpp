#include "render/sampling/spherical_triangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pah {

SphericalTriangle::SphericalTriangle(const Triangle& triangle, const Vec3& from) {
  DVec3 a = DVec3(triangle.a) - DVec3(from);
  DVec3 b = DVec3(triangle.b) - DVec3(from);
  DVec3 c = DVec3(triangle.c) - DVec3(from);
  length_ = {glm::length(a), glm::length(b), glm::length(c)};
  a /= length_.x;
  b /= length_.y;
  c /= length_.z;
  cosine_ = {glm::dot(b, c), glm::dot(c, a), glm::dot(a, b)};
  determinant_ = std::abs(glm::dot(a, glm::cross(b, c)));
  // Not a number, seen from a vertex: nothing.
  const double angle = 2 * std::atan2(determinant_, 1 + cosine_.x + cosine_.y + cosine_.z);
  solid_angle_ = angle > 0 ? angle : 0;
}

bool SphericalTriangle::sampled_by_solid_angle() const {
  // In double the spherical excess of 1e-4 sr keeps eleven digits; from the largest one on,
  // the triangle's own sides pass within a few degrees of great circles.
  return solid_angle_ > 1e-4 && solid_angle_ < 2 * std::numbers::pi - 0.05;
}

// With a, b and c the directions to the vertices, det = det(a, b, c):
//
// The arc from a to c has a point c' for which the triangle a b c' has the share u.x of the solid
// angle, 2 h. It is a mirrored about o, which lies halfway between the two:
// c' = 2 (a o) / (o o) o - a. By Van Oosterom and Strackee's equation,
// cos(h) det(a, b, c') = sin(h) (1 + ab + (a + b) c'), in which det(a, b, c') = det(a, b, c' + a)
// and 1 + ab = (a + b) a. So it holds for c' + a, and for o, which is parallel to it, too:
// cos(h) det(a, b, o) = sin(h) (a + b) o. With o = p a + q c that is
// q (cos(h) det - sin(h) (ac + bc)) = p sin(h) (1 + ab).
//
// On the arc from b to c' the point with cosine z = 1 - u.y (1 - s) to b is wanted, s = b c':
// w = z b + t (c' - s b), where t^2 = (1 - z^2) / (1 - s^2) = u.y (1 + z) / (1 + s).
//
// As a sum of directions to the vertices, w says what barycentrics it has.
Vec2 SphericalTriangle::sample(const Vec2& u) const {
  const auto [bc, ac, ab] = std::array{cosine_.x, cosine_.y, cosine_.z};
  const double h = 0.5 * double{u.x} * solid_angle_;
  const double sin_h = std::sin(h), cos_h = std::cos(h);
  const double p = cos_h * determinant_ - sin_h * (ac + bc);
  const double q = sin_h * (1 + ab);
  const double k = 2 * (p + q * ac) / (p * p + q * q + 2 * p * q * ac);
  const double from_a = k * p - 1, from_c = k * q;  // c'

  const double s = from_a * ab + from_c * bc;
  const double z = 1 - double{u.y} * (1 - s);
  const double t = std::sqrt(double{u.y} * (1 + z) / (1 + s));
  const double a = std::max(0.0, t * from_a) / length_.x;
  const double b = std::max(0.0, z - t * s) / length_.y;
  const double c = std::max(0.0, t * from_c) / length_.z;
  const double sum = a + b + c;
  return {static_cast<float>(b / sum), static_cast<float>(c / sum)};
}

}  // namespace pah
