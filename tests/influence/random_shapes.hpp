// Random shapes, of all scales and in critical positions, for comparisons with exact arithmetic.
#pragma once

#include <cmath>
#include <pah/geometry/basis.hpp>
#include <pah/influence/influence_area.hpp>
#include <random>

struct Shapes {
  explicit Shapes(unsigned seed) : engine(seed) {}

  std::mt19937 engine;

  double uniform(double low = -1, double high = 1) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine); }
  pah::DVec3 vector() { return {uniform(), uniform(), uniform()}; }

  // Powers of ten from 1e-6 to 1e7.
  double scale() { return std::pow(10.0, integer(-6, 7)); }

  // A random direction, sometimes along an axis or a diagonal of two axes.
  pah::DVec3 direction() {
    if (integer(0, 3) != 0) return vector();
    pah::DVec3 d(integer(-1, 1), integer(-1, 1), integer(-1, 1));
    return d == pah::DVec3(0) ? pah::DVec3(0, -1, 0) : d;
  }

  // A random box in [-reach, reach]^3, sometimes flat, a segment or a point.
  pah::Aabb box(double reach) {
    const double size = reach * std::pow(10.0, uniform(-2.5, 0));
    const pah::DVec3 center = reach * vector();
    const pah::DVec3 half = size * glm::abs(vector());
    pah::Aabb result{pah::Vec3(center - half), pah::Vec3(center + half)};
    for (int k = 0; k < 3; ++k)
      if (integer(0, 9) == 0) result.max[k] = result.min[k];
    return result;
  }

  pah::Obb obb(double scale) {
    return {scale * pah::DVec3(pah::Vec3(vector())), pah::orthonormal_basis(direction()),
            scale * (0.1 + glm::abs(vector()))};
  }
  pah::Frustum frustum(double scale) {
    const double far = scale * uniform(0.3, 2);
    return {scale * pah::DVec3(pah::Vec3(vector())),
            pah::orthonormal_basis(direction()),
            {std::pow(10.0, uniform(-1.5, 1)), std::pow(10.0, uniform(-1.5, 1))},
            integer(0, 1) == 0 ? 0 : far * uniform(0, 0.9),
            far};
  }
  pah::Region region(double scale) {
    switch (integer(0, 4)) {
      case 0:
        return box(scale);
      case 1:
      case 2:
        return obb(scale);
      default:
        return frustum(scale);
    }
  }

  // Shapes on a grid, so that faces, edges and corners meet exactly.
  pah::Vec3 grid_point() {
    const auto coordinate = [this] { return 0.5F * static_cast<float>(integer(-14, 14)); };
    return {coordinate(), coordinate(), coordinate()};
  }
  pah::Aabb grid_box() {
    const pah::Vec3 a = grid_point(), b = grid_point();
    return {glm::min(a, b), glm::max(a, b)};
  }
  pah::DMat3 grid_axes() {
    const pah::DMat3 turned(pah::DVec3(0, 1, 0), pah::DVec3(0, 0, 1), pah::DVec3(1, 0, 0));
    const pah::DMat3 flipped(pah::DVec3(0, 1, 0), pah::DVec3(1, 0, 0), pah::DVec3(0, 0, -1));
    const int n = integer(0, 2);
    return n == 0 ? pah::DMat3(1.0) : n == 1 ? turned : flipped;
  }
  pah::Obb grid_obb(int smallest = 0) {
    return {pah::DVec3(integer(-4, 4), integer(-4, 4), integer(-4, 4)), grid_axes(),
            pah::DVec3(integer(smallest, 3), integer(1, 3), integer(1, 3))};
  }
  pah::Frustum grid_frustum() {
    return {pah::DVec3(integer(-4, 4), integer(-4, 4), integer(-4, 4)), grid_axes(),
            pah::DVec2(1, 0.5 * integer(1, 4)), 0.5 * integer(0, 2), 0.5 * integer(2, 8)};
  }
  pah::Region grid_region() {
    if (integer(0, 1) == 0) return grid_obb();
    return grid_frustum();
  }
};
