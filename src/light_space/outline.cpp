#include "light_space/outline.hpp"

#include <cmath>

namespace pah {

namespace {

struct Polygon {
  std::array<DVec3, Outline::most_vertices> vertices;
  std::size_t size = 0;
};

// The part of the polygon where distance >= 0 (Sutherland and Hodgman, "Reentrant Polygon
// Clipping", 1974).
template <typename Distance>
Polygon clipped(const Polygon& polygon, const Distance& distance) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const DVec3& from = polygon.vertices[i];
    const DVec3& to = polygon.vertices[i + 1 < polygon.size ? i + 1 : 0];
    const double d0 = distance(from), d1 = distance(to);
    if (d0 >= 0) inside.vertices[inside.size++] = from;
    if ((d0 >= 0) != (d1 >= 0))
      inside.vertices[inside.size++] = from + (to - from) * (d0 / (d0 - d1));
  }
  return inside;
}

// Whether the plane through three points bounds their depths well: its direction is accurate to
// 2^-33 in double arithmetic, and the sine of the angle at which it is seen is at least 2^-10.
bool bounds_depths(const std::array<DVec3, 3>& p, const DVec3& normal, double facing, double size) {
  const double length = glm::length(normal);
  return length >= 0x1p-20 * glm::length(p[1] - p[0]) * glm::length(p[2] - p[0]) && length > 0 &&
         std::abs(facing) >= 0x1p-10 * length * size;
}

}  // namespace

Interval across(const Outline& outline, const Interval& v) {
  const Interval wide{v.min - outline.margin, v.max + outline.margin};
  Interval u;
  for (std::size_t i = 0; i < outline.size; ++i) {
    const DVec2& a = outline.vertices[i];
    const DVec2& b = outline.vertices[i + 1 < outline.size ? i + 1 : 0];
    if (wide.min <= a.y && a.y <= wide.max) u.extend(a.x);
    for (const double bound : {wide.min, wide.max}) {
      if ((a.y < bound) != (b.y < bound))
        u.extend(a.x + (b.x - a.x) * ((bound - a.y) / (b.y - a.y)));
    }
  }
  if (u.empty()) return u;
  return {u.min - outline.margin, u.max + outline.margin};
}

std::optional<Outline> outline_on(const ParallelView& view, int face, const Triangle& triangle,
                                  double error) {
  const std::array<DVec3, 3> p{view.local(face, DVec3(triangle.a)),
                               view.local(face, DVec3(triangle.b)),
                               view.local(face, DVec3(triangle.c))};
  Outline outline;
  outline.size = 3;
  for (std::size_t i = 0; i < 3; ++i) outline.vertices[i] = p[i];
  outline.margin = error;
  outline.nearest = std::min({p[0].z, p[1].z, p[2].z});
  outline.offset = outline.nearest;
  const DVec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  if (bounds_depths(p, normal, normal.z, 1)) {
    outline.slope = -DVec2(normal) / normal.z;
    outline.offset = p[0].z - glm::dot(outline.slope, DVec2(p[0]));
  }
  return outline;
}

std::optional<Outline> outline_on(const CubeView& view, int face, const Triangle& triangle,
                                  double error) {
  const std::array<DVec3, 3> p{view.local(face, DVec3(triangle.a)),
                               view.local(face, DVec3(triangle.b)),
                               view.local(face, DVec3(triangle.c))};
  const double near = nearest_on_faces * error;
  constexpr double wide = 1 + 1.0 / 16;
  Polygon polygon{{p[0], p[1], p[2]}, 3};
  const std::array<double (*)(const DVec3&, double), 5> sides{
      [](const DVec3& q, double least) { return q.z - least; },
      [](const DVec3& q, double) { return wide * q.z - q.x; },
      [](const DVec3& q, double) { return wide * q.z + q.x; },
      [](const DVec3& q, double) { return wide * q.z - q.y; },
      [](const DVec3& q, double) { return wide * q.z + q.y; }};
  std::array<bool, 5> cuts{};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    int outside = 0;
    for (const DVec3& vertex : p) outside += sides[i](vertex, near) < 0 ? 1 : 0;
    if (outside == 3) return {};
    cuts[i] = outside > 0;
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (!cuts[i]) continue;
    polygon = clipped(polygon, [&](const DVec3& q) { return sides[i](q, near); });
    if (polygon.size == 0) return {};
  }
  Outline outline;
  outline.size = polygon.size;
  outline.nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const DVec3& q = polygon.vertices[i];
    outline.vertices[i] = {q.x / q.z, q.y / q.z};
    outline.nearest = std::min(outline.nearest, q.z);
  }
  outline.margin = margin_at(outline.nearest, error);
  outline.offset = 1 / outline.nearest;
  const DVec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double distance = glm::dot(normal, p[0]);
  if (bounds_depths(p, normal, distance, glm::length(p[0]))) {
    outline.slope = DVec2(normal) / distance;
    outline.offset = normal.z / distance;
  }
  return outline;
}

}  // namespace pah
