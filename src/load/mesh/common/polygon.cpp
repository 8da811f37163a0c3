#include "load/mesh/common/polygon.hpp"

#include <cmath>
#include <cstddef>

namespace pah {
namespace {

double cross(const DVec2& a, const DVec2& b, const DVec2& c) {
  const DVec2 u = b - a;
  const DVec2 v = c - a;
  return u.x * v.y - u.y * v.x;
}

// Projects the corners along the polygon's normal (Newell's formula), so that they run
// counterclockwise.
std::vector<DVec2> flattened(std::span<const Vec3> corners) {
  DVec3 normal{0};
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += glm::cross(DVec3(corners[i]) - DVec3(corners[0]),
                         DVec3(corners[(i + 1) % corners.size()]) - DVec3(corners[0]));
  const DVec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  std::vector<DVec2> points;
  points.reserve(corners.size());
  for (const Vec3& p : corners)
    points.push_back(normal[axis] < 0 ? DVec2(p[v], p[u]) : DVec2(p[u], p[v]));
  return points;
}

bool is_convex(const std::vector<DVec2>& points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i)
    if (cross(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0) return false;
  return true;
}

// Returns whether the corner `at` of the remaining polygon can be cut off.
bool is_ear(const std::vector<DVec2>& points, const std::vector<std::uint32_t>& left,
            std::size_t at) {
  const std::size_t n = left.size();
  const DVec2& a = points[left[(at + n - 1) % n]];
  const DVec2& b = points[left[at]];
  const DVec2& c = points[left[(at + 1) % n]];
  if (cross(a, b, c) <= 0) return false;
  for (const std::uint32_t other : left) {
    const DVec2& p = points[other];
    if (p == a || p == b || p == c) continue;
    if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate(std::span<const Vec3> corners, std::vector<UVec3>& triangles) {
  triangles.clear();
  if (corners.size() == 3) {
    triangles.emplace_back(0, 1, 2);
    return;
  }
  std::vector<std::uint32_t> left(corners.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::uint32_t>(i);
  const std::vector<DVec2> points = flattened(corners);
  // Continuing at the last ear keeps triangles from gathering in one corner.
  std::size_t at = 1;
  std::size_t misses = is_convex(points) ? left.size() : 0;
  while (left.size() > 3 && misses < left.size()) {
    at %= left.size();
    if (is_ear(points, left, at)) {
      const std::size_t n = left.size();
      triangles.emplace_back(left[(at + n - 1) % n], left[at], left[(at + 1) % n]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
      misses = 0;
    } else {
      ++at;
      ++misses;
    }
  }
  // A convex polygon, or one without ears, becomes a fan.
  for (std::size_t i = 2; i < left.size(); ++i)
    triangles.emplace_back(left[0], left[i - 1], left[i]);
}

}  // namespace pah
